// An adaptive binary range coder, and models of numbers on top of it: what small sections are coded with
// where a general compressor would need more bytes for its tables than they have content.
//
// One class codes both ways, so that a format is written down once: every call takes the value, codes it when
// encoding, and answers the value that was coded; when decoding, the argument is ignored.
//
//   RangeCoder out;                      RangeCoder in(bytes);
//   NumberModel m;                       NumberModel m;
//   out.number(m, 42);                   in.number(m) == 42
//   auto bytes = out.finish();           in.failed() == false
//
// Integer arithmetic alone: the same bytes and the same values everywhere. Source: carry propagation as in
// LZMA (G. N. N. Martin, "Range encoding", 1979); each bit's probability is the mean of a fast and a slow
// one.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// The probability that a bit is 0, learnt from the bits so far: quickly from the first ones, slowly later.
struct BitModel {
  std::uint16_t fast = 1u << 15, slow = 1u << 15;  // of 2^16
  std::uint8_t seen = 0;

  void learn(bool bit);
};

// Numbers from 0 to 2^62: how many bits they have, the upper bits learnt for each such count.
struct NumberModel {
  static constexpr int k_learnt = 3;  // bits below the highest one
  std::array<BitModel, 64> width;
  static constexpr std::size_t k_widths = 24;  // wider ones are one: they are rare
  std::array<std::array<BitModel, 1 << k_learnt>, k_widths> upper;
  std::array<BitModel, 1 << k_learnt>& upper_of(std::size_t bits) {
    return upper[bits < k_widths ? bits : k_widths - 1];
  }
};

struct SignedModel {
  NumberModel magnitude;
  std::array<BitModel, 3> sign;  // by the sign before
  int before = 0;
};

// What one stream of a coder took.
struct StreamCost {
  const char* name = "";
  std::uint64_t values = 0;
  double bits = 0;
};

inline constexpr std::uint64_t k_most_signed = std::uint64_t{1} << 40;

class RangeCoder {
 public:
  RangeCoder() : decoding_(false) {}
  explicit RangeCoder(std::span<const std::uint8_t> bytes);  // must outlive this

  bool decoding() const { return decoding_; }
  bool bit(BitModel& model, bool value = false);
  std::uint64_t number(NumberModel& model, std::uint64_t value = 0);
  // Magnitudes up to k_most_signed: sums of what is read cannot overflow.
  std::int64_t signed_number(SignedModel& model, std::int64_t value = 0);
  // `count` bits, 0 to 32, none of them more likely than the other.
  std::uint32_t plain(int count, std::uint32_t value = 0);

  // A bit that is 0 with this probability, of 2^16.
  bool bit_of(std::uint32_t zero_share, bool value);
  // A magnitude, cut off at k_most_signed; a larger one is none that an encoder writes.
  std::uint64_t limited(std::uint64_t magnitude);

  // Encoding: a value of this stream follows, whose bits are counted under its name.
  void stream(const char* name);
  const std::vector<StreamCost>& costs() const { return costs_; }

  // Encoding: the bytes so far. To be called once.
  std::vector<std::uint8_t> finish();
  // Decoding: more was read than is there, or a number that no encoder writes. Reading goes on with zeros.
  bool failed() const { return failed_; }
  // Decoding: bytes that have not been read.
  std::size_t left() const { return bytes_.size() - at_; }
  // Decoding: everything was read and nothing is left over.
  bool exhausted() const { return !failed_ && at_ == bytes_.size(); }

 private:
  void shift_low();
  std::uint8_t next();
  bool split(std::uint32_t bound, bool value);

  bool decoding_, failed_ = false;
  std::uint32_t range_ = 0xffffffffu;
  std::uint32_t code_ = 0;  // decoding
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  std::uint64_t low_ = 0;  // encoding
  std::uint8_t cache_ = 0;
  std::uint64_t pending_ = 0;
  bool first_ = true;
  std::vector<std::uint8_t> out_;
  std::vector<StreamCost> costs_;
  std::size_t stream_ = 0;
};

}  // namespace copse
