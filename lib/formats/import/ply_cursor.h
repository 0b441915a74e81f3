// Walks through the numbers of a PLY file's body.
#pragma once

#include "lib/formats/import/ply_header.h"
#include "lib/formats/import/text.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace copse {

// Numbers as words, separated by blanks and line ends.
class AsciiCursor {
 public:
  static constexpr bool k_lines = true;
  AsciiCursor(std::string_view text, const PlyHeader& header)
      : p_(text.data() + header.size), end_(text.data() + text.size()), line_(header.lines + 1) {}

  std::uint64_t left() const { return static_cast<std::uint64_t>(end_ - p_) + 1; }
  std::uint64_t line() const { return line_; }
  Scan number(PlyType, double& value) {
    skip();
    const char* stop = p_;
    while (stop != end_ && !is_blank(*stop) && *stop != '\n') ++stop;
    if (stop == p_) return Scan::none;
    const Scan scan = scan_double(p_, stop, value);
    p_ = stop;
    return scan;
  }
  bool at_end() {
    skip();
    return p_ == end_;
  }

 private:
  void skip() {
    for (; p_ != end_ && (is_blank(*p_) || *p_ == '\n'); ++p_) line_ += *p_ == '\n';
  }
  const char* p_;
  const char* end_;
  std::uint64_t line_;
};

template <std::endian Order>
class BinaryCursor {
 public:
  static constexpr bool k_lines = false;
  BinaryCursor(std::string_view text, const PlyHeader& header)
      : p_(text.data() + header.size), end_(text.data() + text.size()) {}

  std::uint64_t left() const { return static_cast<std::uint64_t>(end_ - p_); }
  std::uint64_t line() const { return 0; }
  Scan number(PlyType type, double& value) {
    switch (type) {
      case PlyType::i8:
        return load<std::int8_t>(value);
      case PlyType::u8:
        return load<std::uint8_t>(value);
      case PlyType::i16:
        return load<std::int16_t>(value);
      case PlyType::u16:
        return load<std::uint16_t>(value);
      case PlyType::i32:
        return load<std::int32_t>(value);
      case PlyType::u32:
        return load<std::uint32_t>(value);
      case PlyType::f32:
        return load<float>(value);
      case PlyType::f64:
        return load<double>(value);
    }
    return Scan::bad;
  }
  bool at_end() const { return p_ == end_; }

 private:
  template <class Number>
  Scan load(double& value) {
    if (left() < sizeof(Number)) return Scan::none;
    std::array<char, sizeof(Number)> bytes;
    std::memcpy(bytes.data(), p_, sizeof(Number));
    p_ += sizeof(Number);
    if constexpr (Order != std::endian::native) std::reverse(bytes.begin(), bytes.end());
    value = static_cast<double>(std::bit_cast<Number>(bytes));
    return std::isfinite(value) ? Scan::good : Scan::not_finite;
  }
  const char* p_;
  const char* end_;
};

}  // namespace copse
