#include "lib/formats/import/image.h"

#include "lib/formats/import/images/plugin.h"
#include "lib/formats/import/plain_image.h"
#include "lib/formats/import/source.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string_view>
#include <utility>

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace copse {
namespace {

struct Plugin {
  CopseImageDecode decode = nullptr;
  CopseImageDecodeFloats decode_floats = nullptr;
  CopseImageEncode encode = nullptr;
  std::string problem;  // why it could not be loaded
};

// Beside the tools as built, installed, or wherever the loader looks.
std::vector<std::string> candidates() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  std::vector<std::string> out;
  if (!error) {
    out.push_back((folder / "../lib/libcopse_images.so").string());
    out.push_back((folder / "../lib/copse/libcopse_images.so").string());
  }
  out.emplace_back("libcopse_images.so");
  return out;
}

template <class Function>
bool find(void* library, const char* name, Function& out) {
  out = reinterpret_cast<Function>(::dlsym(library, name));
  return out != nullptr;
}

Plugin load() {
  Plugin plugin;
  for (const std::string& name : candidates()) {
    void* library = ::dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
      const char* reason = ::dlerror();
      plugin.problem = reason != nullptr ? reason : name;
      continue;
    }
    CopseImageVersion version = nullptr;
    if (find(library, "copse_image_version", version) && version() == COPSE_IMAGES_VERSION &&
        find(library, "copse_image_decode", plugin.decode) &&
        find(library, "copse_image_decode_floats", plugin.decode_floats) &&
        find(library, "copse_image_encode", plugin.encode)) {
      plugin.problem.clear();
      return plugin;
    }
    plugin.problem = name + " is of another version";
  }
  return plugin;
}

Result<const Plugin*> plugin(const std::string& file) {
  static const Plugin loaded = load();
  if (!loaded.problem.empty())
    return fail(Fault::io, file, "needs the image plug-in, which cannot be loaded: " + loaded.problem,
                "install copse with its lib folder, or use meshes without images");
  return &loaded;
}

struct Magic {
  std::string_view bytes;
  const char* format;
};
// As OpenImageIO names them. Formats whose readers have a history of flaws are left out.
using namespace std::string_view_literals;
constexpr std::array k_magic{Magic{"\x89PNG"sv, "png"},
                             Magic{"\xff\xd8\xff"sv, "jpeg"},
                             Magic{"GIF8"sv, "gif"},
                             Magic{"BM"sv, "bmp"},
                             Magic{"II\x2a\0"sv, "tiff"},
                             Magic{"MM\0\x2a"sv, "tiff"},
                             Magic{"\x76\x2f\x31\x01"sv, "openexr"},
                             Magic{"#?"sv, "hdr"},
                             Magic{"RIFF"sv, "webp"}};

struct Extension {
  std::string_view name;
  const char* format;
};
constexpr std::array k_extensions{
    Extension{".png", "png"},     Extension{".jpg", "jpeg"},  Extension{".jpeg", "jpeg"},
    Extension{".exr", "openexr"}, Extension{".tif", "tiff"},  Extension{".tiff", "tiff"},
    Extension{".hdr", "hdr"},     Extension{".webp", "webp"}, Extension{".bmp", "bmp"},
    Extension{".tga", "targa"},   Extension{".gif", "gif"}};

const char* format_by_name(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  for (const Extension& extension : k_extensions) {
    if (name.ends_with(extension.name)) return extension.format;
  }
  return nullptr;
}

const char* format_of(std::span<const std::uint8_t> bytes, const std::string& name) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  for (const auto& [magic, format] : k_magic) {
    if (text.starts_with(magic)) return format;
  }
  const char* named = format_by_name(name);
  return named != nullptr && std::string_view(named) == "targa" ? named : nullptr;  // the one without a magic
}

std::uint8_t* allocate(void* user, int width, int height, int has_alpha) {
  auto& image = *static_cast<Image*>(user);
  const std::uint64_t pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  if (pixels > k_image_pixels) return nullptr;
  image.width = width;
  image.height = height;
  image.has_alpha = has_alpha != 0;
  try {
    image.rgba.resize(pixels * 4);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
  return image.rgba.data();
}

float* allocate_floats(void* user, int width, int height, int channels) {
  auto& image = *static_cast<FloatImage*>(user);
  const std::uint64_t numbers = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) *
                                static_cast<std::uint64_t>(channels);
  if (numbers > k_image_pixels) return nullptr;
  image.width = width;
  image.height = height;
  image.channels = channels;
  try {
    image.values.resize(numbers);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
  return image.values.data();
}

void append(void* user, const std::uint8_t* bytes, std::size_t size) {
  static_cast<std::vector<std::uint8_t>*>(user)->assign(bytes, bytes + size);
}

// The library's messages may have several lines.
std::string one_line(const char* text) {
  std::string out = text;
  while (!out.empty() && out.back() == '\n') out.pop_back();
  std::replace(out.begin(), out.end(), '\n', ' ');
  return out;
}

Result<std::vector<std::uint8_t>> encode(const Image& image, const char* format, const std::string& file) {
  const std::uint64_t pixels = static_cast<std::uint64_t>(std::max(image.width, 0)) *
                               static_cast<std::uint64_t>(std::max(image.height, 0));
  if (pixels == 0 || pixels > k_image_pixels || image.rgba.size() != pixels * 4)
    return fail(
        Fault::bug, file,
        fmt::format("an image of {} x {} with {} bytes", image.width, image.height, image.rgba.size()),
        "report this");
  const Result<const Plugin*> library = plugin(file);
  if (!library) return std::unexpected(library.error());
  std::vector<std::uint8_t> bytes;
  CopseImageError error{};
  if ((*library)->encode(image.rgba.data(), image.width, image.height, image.has_alpha ? 1 : 0, format,
                         append, &bytes, &error) != 0)
    return fail(Fault::io, file, fmt::format("cannot be encoded as {}: {}", format, one_line(error.text)),
                "choose another format");
  return bytes;
}

bool write_all(int file, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(std::max<ssize_t>(written, 0)));
  }
  return true;
}

}  // namespace

Result<Image> read_image(std::span<const std::uint8_t> bytes, const std::string& name) {
  const char* format = format_of(bytes, name);
  if (format == nullptr)
    return refuse(name, "is of no image format that is read here", "convert it to PNG or JPEG");
  Image image;
  if (decode_plain_image(bytes, image)) return image;
  image = {};
  const Result<const Plugin*> library = plugin(name);
  if (!library) return std::unexpected(library.error());
  CopseImageError error{};
  if ((*library)->decode(bytes.data(), bytes.size(), format, allocate, &image, &error) != 0)
    return refuse(name, fmt::format("cannot be read as {}: {}", format, one_line(error.text)),
                  fmt::format("store it again, with at most {} pixels", k_image_pixels));
  return image;
}

Result<Image> read_image(const std::filesystem::path& path) {
  const Result<Bytes> bytes = open_bytes(path);
  if (!bytes) return std::unexpected(bytes.error());
  return read_image(*bytes, path.string());
}

Result<FloatImage> read_float_image(const std::filesystem::path& path) {
  const std::string name = path.string();
  const Result<Bytes> bytes = open_bytes(path);
  if (!bytes) return std::unexpected(bytes.error());
  const std::span<const std::uint8_t> view = *bytes;
  const char* format = format_of(view, name);
  if (format == nullptr)
    return refuse(name, "is of no image format that is read here", "convert it to PNG, TIFF or EXR");
  const Result<const Plugin*> library = plugin(name);
  if (!library) return std::unexpected(library.error());
  FloatImage image;
  CopseImageError error{};
  if ((*library)->decode_floats(view.data(), view.size(), format, allocate_floats, &image, &error) != 0)
    return refuse(name, fmt::format("cannot be read as {}: {}", format, one_line(error.text)),
                  fmt::format("store it again, with at most {} numbers", k_image_pixels));
  return image;
}

Result<std::vector<std::uint8_t>> encode_png(const Image& image) {
  return encode(image, "png", "");
}

Result<void> write_image(const std::filesystem::path& path, const Image& image) {
  const std::string name = path.string();
  const char* format = format_by_name(name);
  if (format == nullptr)
    return fail(Fault::usage, name, "has the extension of no image format that is written here",
                "use .png, .jpg, .exr, .tif, .hdr, .webp, .bmp, .tga or .gif");
  const auto bytes = encode(image, format, name);
  if (!bytes) return std::unexpected(bytes.error());
  std::string beside = name + ".XXXXXX";
  const int file = ::mkstemp(beside.data());
  const auto failed = [&](int code) {
    if (file >= 0) ::unlink(beside.c_str());
    return fail(Fault::io, name, fmt::format("cannot be written: {}", std::strerror(code)),
                "check the folder and the space on its disk");
  };
  if (file < 0) return failed(errno);
  const bool written = write_all(file, *bytes) && ::fchmod(file, 0644) == 0 && ::fsync(file) == 0;
  const int code = errno;
  ::close(file);
  if (!written) return failed(code);
  if (::rename(beside.c_str(), name.c_str()) != 0) return failed(errno);
  return {};
}

}  // namespace copse
