// libcopse_images.so: images through OpenImageIO.
#include "lib/formats/import/images/plugin.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <unistd.h>

namespace {

// One thread: the bytes must not depend on the machine. Sizes are bounded by the caller, these only stop the
// library itself from taking memory for what a header claims.
void configure() {
  static const bool done = [] {
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
    OIIO::attribute("limits:imagesize_MB", 2048);
    OIIO::attribute("limits:channels", 64);
    return true;
  }();
  (void)done;
}

int report(CopseImageError* error, const std::string& text) {
  std::snprintf(error->text, sizeof error->text, "%s", text.c_str());
  return 1;
}

std::uint8_t to_byte(float v) {
  return static_cast<std::uint8_t>(
      std::lround(std::clamp(v, 0.0f, 1.0f) * 255.0f));  // NaN is clamped to an end too
}

std::uint8_t linear_to_srgb(float v) {
  if (!(v > 0)) return 0;
  return to_byte(v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(std::min(v, 1.0f), 1 / 2.4f) - 0.055f);
}

float srgb_to_linear(std::uint8_t b) {
  const float v = static_cast<float>(b) / 255.0f;
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

bool is_linear(const OIIO::ImageSpec& spec) {
  return spec.format.is_floating_point();
}

// libpng prints its complaints to stderr, where a tool says one line and no more. While an image is decoded
// that line is collected instead, and ends up in the error. What other threads print meanwhile passes
// through.
class Complaints {
 public:
  Complaints() {
    const std::lock_guard lock(mutex());
    mine() = &text_;
    if (users()++ == 0) original() = std::exchange(stderr, stream());
  }
  Complaints(const Complaints&) = delete;
  Complaints& operator=(const Complaints&) = delete;
  ~Complaints() {
    const std::lock_guard lock(mutex());
    mine() = nullptr;
    if (--users() == 0) stderr = original();
  }
  const std::string& text() const { return text_; }

 private:
  static std::mutex& mutex() {
    static std::mutex instance;
    return instance;
  }
  static int& users() {
    static int count = 0;
    return count;
  }
  static std::FILE*& original() {
    static std::FILE* file = nullptr;
    return file;
  }
  static std::string*& mine() {
    thread_local std::string* text = nullptr;
    return text;
  }
  static ssize_t put(void*, const char* bytes, std::size_t size) {
    if (mine() != nullptr) {
      if (mine()->size() < 1024) mine()->append(bytes, size);
      return static_cast<ssize_t>(size);
    }
    return ::write(STDERR_FILENO, bytes, size);
  }
  // Never closed: another thread may be about to print to it.
  static std::FILE* stream() {
    static std::FILE* file = [] {
      cookie_io_functions_t functions{};
      functions.write = put;
      std::FILE* made = ::fopencookie(nullptr, "w", functions);
      if (made != nullptr) std::setvbuf(made, nullptr, _IONBF, 0);
      return made != nullptr ? made : stderr;
    }();
    return file;
  }

  std::string text_;
};

struct Layout {
  int channels;  // that are read: 1 to 4
  int alpha;     // which of them is alpha, or -1
};

Layout layout_of(const OIIO::ImageSpec& spec) {
  const int channels = std::min(spec.nchannels, 4);
  int alpha = spec.alpha_channel >= 0 && spec.alpha_channel < channels ? spec.alpha_channel : -1;
  if (alpha < 0 && (channels == 2 || channels == 4)) alpha = channels - 1;
  return {channels, alpha};
}

// Spreads grey to RGB and gives alpha its place. Floating-point images are linear and premultiplied.
template <class Number, class Colour>
void expand(const std::vector<Number>& from, const Layout& layout, std::uint8_t* to, std::size_t pixels,
            std::uint8_t opaque, Colour&& colour) {
  const auto n = static_cast<std::size_t>(layout.channels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const Number* p = from.data() + i * n;
    const bool grey = layout.channels < 3;
    for (std::size_t c = 0; c < 3; ++c)
      to[4 * i + c] = colour(p[grey ? 0 : c], layout.alpha < 0 ? nullptr : p + layout.alpha);
    if (layout.alpha < 0) {
      to[4 * i + 3] = opaque;
    } else if constexpr (std::is_same_v<Number, float>) {
      to[4 * i + 3] = to_byte(p[layout.alpha]);
    } else {
      to[4 * i + 3] = p[layout.alpha];
    }
  }
}

// An image that is open, and the bytes that it is read from. `wrong` says why it is not.
struct Opened {
  OIIO::Filesystem::IOMemReader memory;
  std::unique_ptr<OIIO::ImageInput> input;
  OIIO::ImageSpec spec;
  std::string wrong;

  Opened(const std::uint8_t* bytes, std::size_t size, const char* format) : memory(bytes, size) {
    configure();
    wrong = open(format);
  }
  std::size_t pixels() const {
    return static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
  }
  // After reading; 0 when `good`.
  int close(bool good, CopseImageError* error) {
    const std::string reason = good ? std::string() : input->geterror();
    input->close();
    return good ? 0 : report(error, reason.empty() ? "its pixels cannot be read" : reason);
  }

 private:
  std::string open(const char* format) {
    input = OIIO::ImageInput::create(format);
    if (!input) return OIIO::geterror();
    if (!input->supports("ioproxy")) return "the format cannot be read from memory";
    input->set_ioproxy(&memory);
    OIIO::ImageSpec config;
    config["oiio:UnassociatedAlpha"] = 1;
    if (!input->open(std::string("image.") + format, spec, config)) return input->geterror();
    if (spec.width <= 0 || spec.height <= 0 || spec.depth > 1 || spec.nchannels < 1 || spec.deep)
      return "it has no pixels that make a picture";
    return {};
  }
};

int decode(const std::uint8_t* bytes, std::size_t size, const char* format, CopseImageAllocate allocate,
           void* user, CopseImageError* error) {
  Opened image(bytes, size, format);
  if (!image.wrong.empty()) return report(error, image.wrong);
  const Layout layout = layout_of(image.spec);
  std::uint8_t* out = allocate(user, image.spec.width, image.spec.height, layout.alpha >= 0 ? 1 : 0);
  if (out == nullptr) return report(error, "it is too large");
  const std::size_t numbers = image.pixels() * static_cast<std::size_t>(layout.channels);
  bool good = false;
  if (is_linear(image.spec)) {
    std::vector<float> buffer(numbers);
    good = image.input->read_image(0, 0, 0, layout.channels, OIIO::TypeDesc::FLOAT, buffer.data());
    expand(buffer, layout, out, image.pixels(), 255, [](float v, const float* alpha) {
      return linear_to_srgb(alpha != nullptr && *alpha > 0 ? v / *alpha : v);
    });
  } else {
    std::vector<std::uint8_t> buffer(numbers);
    good = image.input->read_image(0, 0, 0, layout.channels, OIIO::TypeDesc::UINT8, buffer.data());
    expand(buffer, layout, out, image.pixels(), 255, [](std::uint8_t v, const std::uint8_t*) { return v; });
  }
  return image.close(good, error);
}

int decode_floats(const std::uint8_t* bytes, std::size_t size, const char* format,
                  CopseImageAllocateFloats allocate, void* user, CopseImageError* error) {
  Opened image(bytes, size, format);
  if (!image.wrong.empty()) return report(error, image.wrong);
  float* out = allocate(user, image.spec.width, image.spec.height, image.spec.nchannels);
  if (out == nullptr) return report(error, "it is too large");
  return image.close(image.input->read_image(0, 0, 0, image.spec.nchannels, OIIO::TypeDesc::FLOAT, out),
                     error);
}

// Pixels as the file wants them: bytes, or linear premultiplied floats.
std::vector<float> to_linear(const std::uint8_t* rgba, std::size_t pixels, std::size_t channels) {
  std::vector<float> out;
  out.reserve(pixels * channels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const float alpha = channels == 4 ? static_cast<float>(rgba[4 * i + 3]) / 255.0f : 1.0f;
    for (std::size_t c = 0; c < 3; ++c) out.push_back(srgb_to_linear(rgba[4 * i + c]) * alpha);
    if (channels == 4) out.push_back(alpha);
  }
  return out;
}

std::vector<std::uint8_t> to_packed(const std::uint8_t* rgba, std::size_t pixels, std::size_t channels) {
  std::vector<std::uint8_t> out;
  out.reserve(pixels * channels);
  for (std::size_t i = 0; i < pixels; ++i) out.insert(out.end(), rgba + 4 * i, rgba + 4 * i + channels);
  return out;
}

int encode(const std::uint8_t* rgba, int width, int height, int has_alpha, const char* format,
           CopseImageSink sink, void* user, CopseImageError* error) {
  configure();
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
  if (!output) return report(error, OIIO::geterror());
  if (output->supports("ioproxy") == 0) return report(error, "the format cannot be written from memory");
  const std::string name = format;
  const bool floats = name == "openexr" || name == "hdr";
  const bool alpha = has_alpha != 0 && output->supports("alpha") != 0;
  const int channels = alpha ? 4 : 3;
  OIIO::ImageSpec spec(width, height, channels, floats ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::UINT8);
  if (name == "hdr") spec.format = OIIO::TypeDesc::FLOAT;
  if (!floats) spec["oiio:UnassociatedAlpha"] = 1;
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  output->set_ioproxy(&memory);
  if (!output->open("image." + name, spec)) return report(error, output->geterror());
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  const bool good =
      floats ? output->write_image(OIIO::TypeDesc::FLOAT,
                                   to_linear(rgba, pixels, static_cast<std::size_t>(channels)).data())
             : output->write_image(OIIO::TypeDesc::UINT8,
                                   to_packed(rgba, pixels, static_cast<std::size_t>(channels)).data());
  const bool closed = output->close();
  if (!good || !closed) return report(error, output->geterror());
  sink(user, bytes.data(), bytes.size());
  return 0;
}

template <class Function>
int guarded(CopseImageError* error, Function&& function) {
  try {
    return function();
  } catch (const std::exception& e) {
    return report(error, e.what());
  } catch (...) {
    return report(error, "an unknown failure");
  }
}

}  // namespace

extern "C" {

[[gnu::visibility("default")]] int copse_image_version() {
  return COPSE_IMAGES_VERSION;
}

[[gnu::visibility("default")]] int copse_image_decode(const std::uint8_t* bytes, std::size_t size,
                                                      const char* format, CopseImageAllocate allocate,
                                                      void* user, CopseImageError* error) {
  return guarded(error, [&] {
    const Complaints complaints;
    const int status = decode(bytes, size, format, allocate, user, error);
    // OpenImageIO's own words are often none when the library below has spoken.
    if (status != 0 && !complaints.text().empty()) return report(error, complaints.text());
    return status;
  });
}

[[gnu::visibility("default")]] int copse_image_decode_floats(const std::uint8_t* bytes, std::size_t size,
                                                             const char* format,
                                                             CopseImageAllocateFloats allocate, void* user,
                                                             CopseImageError* error) {
  return guarded(error, [&] {
    const Complaints complaints;
    const int status = decode_floats(bytes, size, format, allocate, user, error);
    if (status != 0 && !complaints.text().empty()) return report(error, complaints.text());
    return status;
  });
}

[[gnu::visibility("default")]] int copse_image_encode(const std::uint8_t* rgba, int width, int height,
                                                      int has_alpha, const char* format, CopseImageSink sink,
                                                      void* user, CopseImageError* error) {
  return guarded(error, [&] { return encode(rgba, width, height, has_alpha, format, sink, user, error); });
}
}
