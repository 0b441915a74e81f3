#include "lib/formats/packing/context_mixing.h"

#include <algorithm>
#include <bit>

namespace copse {
namespace {

constexpr int k_unit = 256;              // of the logistic scale: 1
constexpr int k_far = 11 * k_unit;       // beyond it a bit is certain
constexpr std::int32_t k_begin = 65536;  // sum of the weights at first, of 2^16, and half as much again
constexpr std::int64_t k_most_weight = 8 * 65536;

// x of the logistic scale to a probability of 2^16, and back from its upper 12 bits.
struct Tables {
  std::array<std::uint16_t, 2 * k_far + 1> squash;
  std::array<std::int16_t, 4096> stretch;

  Tables() {
    const double h = 1.0 / k_unit, step = 1 + h * (1 + h / 2 * (1 + h / 3 * (1 + h / 4 * (1 + h / 5))));
    double power = 1;  // e^(x / k_unit)
    for (int x = 0; x <= k_far; ++x, power *= step) {
      squash[static_cast<std::size_t>(k_far + x)] = static_cast<std::uint16_t>(65536 * power / (1 + power));
      squash[static_cast<std::size_t>(k_far - x)] = static_cast<std::uint16_t>(65536 / (1 + power));
    }
    std::size_t at = 0;
    for (std::size_t p = 0; p < stretch.size(); ++p) {
      while (at + 1 < squash.size() && squash[at] < 16 * p + 8) ++at;
      stretch[p] = static_cast<std::int16_t>(static_cast<int>(at) - k_far);
    }
  }
};
const Tables& tables() {
  static const Tables t;
  return t;
}

}  // namespace

bool BitMixer::code(RangeCoder& coder, std::span<BitModel* const> models, bool value) {
  const Tables& t = tables();
  if (seen_ == 0) weights_.fill(k_begin * 3 / 2 / static_cast<std::int32_t>(models.size() + 1));
  std::array<std::int32_t, k_most> sides{};
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < models.size(); ++i) {
    const std::uint32_t zero = (std::uint32_t{models[i]->fast} + models[i]->slow) >> 1;
    sides[i] = t.stretch[zero >> 4];
    sum += std::int64_t{weights_[i]} * sides[i];
  }
  const auto x = static_cast<std::size_t>(std::clamp<std::int64_t>(sum >> 16, -k_far, k_far) + k_far);
  const std::int32_t zero = t.squash[x];
  value = coder.bit_of(static_cast<std::uint32_t>(zero), value);
  const std::int64_t off = (value ? 0 : 65535) - zero;
  const std::int64_t rate = 6 + 192 / (8 + std::int64_t{seen_});
  for (std::size_t i = 0; i < models.size(); ++i) {
    weights_[i] = static_cast<std::int32_t>(
        std::clamp(weights_[i] + ((sides[i] * off * rate) >> 20), -k_most_weight, k_most_weight));
    models[i]->learn(value);
  }
  if (seen_ < 0xffff) ++seen_;
  return value;
}

MixedBit::MixedBit(Contexts sizes) {
  for (const std::size_t n : sizes) models_.emplace_back(n);
}

bool MixedBit::code(RangeCoder& coder, Contexts contexts, bool value) {
  std::array<BitModel*, BitMixer::k_most> models{};
  std::size_t n = 0;
  for (const std::size_t c : contexts) {
    models[n] = &models_[n][std::min(c, models_[n].size() - 1)];
    ++n;
  }
  return mixer_.code(coder, std::span(models).first(n), value);
}

MixedNumber::MixedNumber(Contexts sizes) {
  for (const std::size_t n : sizes) models_.emplace_back(n);
}

std::uint64_t MixedNumber::code(RangeCoder& coder, Contexts contexts, std::uint64_t value) {
  std::array<NumberModel*, BitMixer::k_most> numbers{};
  std::array<BitModel*, BitMixer::k_most> models{};
  std::size_t n = 0;
  for (const std::size_t c : contexts) {
    numbers[n] = &models_[n][std::min(c, models_[n].size() - 1)];
    ++n;
  }
  const auto used = std::span(models).first(n);
  const int bits = std::bit_width(value);
  std::uint32_t width = 1;
  for (int i = 5; i >= 0; --i) {
    for (std::size_t k = 0; k < n; ++k) models[k] = &numbers[k]->width[width];
    width = width << 1 | (width_[width].code(coder, used, (bits >> i & 1) != 0) ? 1u : 0u);
  }
  width &= 63;
  if (width == 0) return 0;
  std::uint64_t out = 1;
  std::uint32_t prefix = 1;
  for (int i = static_cast<int>(width) - 2, learnt = 0; i >= 0; --i, ++learnt) {
    const bool set = (value >> i & 1) != 0;
    bool got = false;
    if (learnt < NumberModel::k_learnt) {
      for (std::size_t k = 0; k < n; ++k) models[k] = &numbers[k]->upper_of(width)[prefix];
      got = upper_[static_cast<std::size_t>(learnt)].code(coder, used, set);
      prefix = prefix << 1 | (got ? 1u : 0u);
    } else {
      got = coder.plain(1, set ? 1 : 0) != 0;
    }
    out = out << 1 | (got ? 1u : 0u);
  }
  return out;
}

MixedSymbol::MixedSymbol(std::size_t count, Contexts sizes)
    : bits_(std::bit_width(count - 1)), mixers_(std::size_t{1} << bits_) {
  for (const std::size_t n : sizes) models_.emplace_back(n << bits_);
}

std::size_t MixedSymbol::code(RangeCoder& coder, Contexts contexts, std::size_t value) {
  std::array<BitModel*, BitMixer::k_most> nodes{}, models{};
  std::size_t n = 0;
  for (const std::size_t c : contexts) {
    const std::size_t last = (models_[n].size() >> bits_) - 1;
    nodes[n] = &models_[n][std::min(c, last) << bits_];
    ++n;
  }
  std::size_t symbol = 1;
  for (int i = bits_ - 1; i >= 0; --i) {
    for (std::size_t k = 0; k < n; ++k) models[k] = nodes[k] + symbol;
    symbol = symbol << 1 |
             (mixers_[symbol].code(coder, std::span(models).first(n), (value >> i & 1) != 0) ? 1u : 0u);
  }
  return symbol - (std::size_t{1} << bits_);
}

MixedSigned::MixedSigned(Contexts sizes) : magnitude_(sizes) {
  for (const std::size_t n : sizes) signs_.emplace_back(n);
}

std::int64_t MixedSigned::code(RangeCoder& coder, Contexts contexts, std::int64_t value) {
  const std::uint64_t size =
      magnitude_.code(coder, contexts, static_cast<std::uint64_t>(value < 0 ? -value : value));
  bool negative = false;
  if (size != 0) {
    std::array<BitModel*, BitMixer::k_most> models{};
    std::size_t n = 0;
    for (const std::size_t c : contexts) {
      models[n] = &signs_[n][std::min(c, signs_[n].size() - 1)][before_];
      ++n;
    }
    negative = mixer_.code(coder, std::span(models).first(n), value < 0);
  }
  before_ = size == 0 ? 0 : negative ? 1 : 2;
  const auto out = static_cast<std::int64_t>(coder.limited(size));
  return negative ? -out : out;
}

}  // namespace copse
