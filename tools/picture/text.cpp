#include "tools/picture/text.h"

#include <cmath>

#include <imgui.h>

namespace copse {
namespace {

class Font {
 public:
  Font() {
    ImFontConfig config;
    config.SizePixels = k_text_height;
    config.OversampleH = config.OversampleV = 1;  // a texel a pixel
    config.PixelSnapH = true;
    font_ = atlas_.AddFontDefault(&config);
    atlas_.GetTexDataAsAlpha8(&pixels_, &width_, &height_);
  }

  // Calls visit(glyph, x) for every glyph, x the pen before it; answers where the pen ends.
  template <class Visit>
  float walk(std::string_view text, Visit&& visit) const {
    float pen = 0;
    for (std::size_t i = 0; i < text.size();) {
      const ImFontGlyph* glyph = font_->FindGlyphNoFallback(static_cast<ImWchar>(next(text, i)));
      if (!glyph) glyph = font_->FindGlyph('?');
      visit(*glyph, pen);
      pen += glyph->AdvanceX;
    }
    return pen;
  }

  std::uint8_t coverage(const ImFontGlyph& g, int x, int y) const {
    const int u = static_cast<int>(std::lround(g.U0 * static_cast<float>(width_))) + x;
    const int v = static_cast<int>(std::lround(g.V0 * static_cast<float>(height_))) + y;
    return pixels_[v * width_ + u];
  }

 private:
  // The next code point, above Latin-1 and of broken UTF-8 none that the font has.
  static unsigned next(std::string_view text, std::size_t& i) {
    const auto byte = static_cast<unsigned char>(text[i++]);
    if (byte < 0x80) return byte;
    unsigned code = byte >= 0xc2 && byte < 0xc4 ? byte & 3u : 0xfff;
    for (; i < text.size() && (static_cast<unsigned char>(text[i]) & 0xc0) == 0x80; ++i)
      if (code < 4) code = code << 6 | (static_cast<unsigned char>(text[i]) & 0x3fu);
    return code;
  }

  ImFontAtlas atlas_;
  ImFont* font_ = nullptr;
  unsigned char* pixels_ = nullptr;
  int width_ = 0, height_ = 0;
};

const Font& font() {
  static const Font instance;
  return instance;
}

}  // namespace

int text_width(std::string_view text) {
  return static_cast<int>(std::ceil(font().walk(text, [](const ImFontGlyph&, float) {})));
}

void draw_text(Image& image, int x, int y, std::string_view text, const std::array<std::uint8_t, 3>& colour) {
  font().walk(text, [&](const ImFontGlyph& g, float pen) {
    const int left = x + static_cast<int>(std::lround(pen + g.X0)),
              top = y + static_cast<int>(std::lround(g.Y0));
    const int across = static_cast<int>(std::lround(g.X1 - g.X0)),
              down = static_cast<int>(std::lround(g.Y1 - g.Y0));
    for (int v = 0; v < down; ++v)
      for (int u = 0; u < across; ++u) {
        const int px = left + u, py = top + v;
        if (px < 0 || py < 0 || px >= image.width || py >= image.height) continue;
        const int alpha = font().coverage(g, u, v);
        std::uint8_t* p =
            image.rgba.data() + 4 * (static_cast<std::size_t>(py) * static_cast<std::size_t>(image.width) +
                                     static_cast<std::size_t>(px));
        for (std::size_t c = 0; c < 3; ++c)
          p[c] = static_cast<std::uint8_t>((p[c] * (255 - alpha) + colour[c] * alpha + 127) / 255);
      }
  });
}

}  // namespace copse
