// Numbers foretold from several sides at once: for every bit, what each of several contexts has learnt is
// mixed, and how far each is to be trusted is learnt too. It takes some times as long as one context a
// number.
//
//   MixedSigned m{5, 16};                  // the first context has 5 values, the second 16
//   value = m.code(coder, {kind, size}, value);
//
// As RangeCoder, it codes both ways. Integer arithmetic alone but for one table, which is made by + * / of
// doubles: the same bytes everywhere. Source: M. Mahoney, "Adaptive weighing of context models for lossless
// data compression", 2005.
#pragma once

#include "lib/formats/packing/range_coder.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

namespace copse {

// How far each of several opinions on a bit is to be trusted.
class BitMixer {
 public:
  static constexpr std::size_t k_most = 6;
  // The bit, whose models each are that of one context.
  bool code(RangeCoder& coder, std::span<BitModel* const> models, bool value);

 private:
  std::array<std::int32_t, k_most> weights_{};  // of 2^16; 0 models: not begun
  std::uint32_t seen_ = 0;
};

// A context that is not below its number of values is its last value.
using Contexts = std::initializer_list<std::size_t>;

class MixedBit {
 public:
  MixedBit(Contexts sizes);
  bool code(RangeCoder& coder, Contexts contexts, bool value = false);

 private:
  std::vector<std::vector<BitModel>> models_;
  BitMixer mixer_;
};

// Numbers from 0 to 2^62.
class MixedNumber {
 public:
  MixedNumber(Contexts sizes);
  std::uint64_t code(RangeCoder& coder, Contexts contexts, std::uint64_t value = 0);

 private:
  std::vector<std::vector<NumberModel>> models_;
  std::array<BitMixer, 64> width_;
  std::array<BitMixer, NumberModel::k_learnt> upper_;
};

// Numbers below a count of at most 256. Contexts are small: there may be many.
class MixedSymbol {
 public:
  MixedSymbol(std::size_t count, Contexts sizes);
  // Decoding a forged stream answers up to the next power of two above the count.
  std::size_t code(RangeCoder& coder, Contexts contexts, std::size_t value = 0);

 private:
  int bits_;
  std::vector<std::vector<BitModel>> models_;  // of each context so many as a tree of bits has nodes
  std::vector<BitMixer> mixers_;
};

// Magnitudes up to k_most_signed.
class MixedSigned {
 public:
  MixedSigned(Contexts sizes);
  std::int64_t code(RangeCoder& coder, Contexts contexts, std::int64_t value = 0);

 private:
  MixedNumber magnitude_;
  std::vector<std::vector<std::array<BitModel, 3>>> signs_;
  BitMixer mixer_;
  std::size_t before_ = 0;
};

// How many bits the size of a number has: what residuals of like size have in common.
inline std::size_t size_class(std::int64_t x) {
  std::size_t bits = 0;
  for (std::uint64_t m = static_cast<std::uint64_t>(x < 0 ? -x : x); m != 0; m >>= 1) ++bits;
  return bits;
}

}  // namespace copse
