// Words in pictures, in the font that Dear ImGui carries: the same pixels on every machine.
#pragma once

#include "lib/formats/import/image.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace copse {

inline constexpr int k_text_height = 26;  // pixels, from the top of a line to that of the next

// Pixels that it takes. UTF-8; what the font has not (it has Latin-1) is a question mark.
int text_width(std::string_view text);

// Draws over what is there, its upper left corner at (x, y); what does not fit is cut off.
void draw_text(Image& image, int x, int y, std::string_view text, const std::array<std::uint8_t, 3>& colour);

}  // namespace copse
