#include "lib/formats/packing/range_coder.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string_view>

namespace copse {
namespace {

constexpr std::uint32_t k_top = 1u << 24;
constexpr int k_tail = 4;  // bytes of the code that the decoder reads ahead
constexpr int k_fast_rate = 5, k_slow_rate = 7;

std::uint32_t zero_share(const BitModel& m) {
  return std::clamp((std::uint32_t{m.fast} + m.slow) >> 1, 64u, 65536u - 64u);
}

}  // namespace

void BitModel::learn(bool bit) {
  // The first bits count fully: after n of them each weighs 1 / (n + 1.5).
  const int n = seen;
  if (seen < 255) ++seen;
  const auto moved = [&](std::uint16_t p, int rate) {
    const std::int32_t target = bit ? 0 : 65535, way = target - p;
    const std::int32_t by = 2 * n + 3 < (2 << rate) ? 2 * way / (2 * n + 3) : way / (1 << rate);
    return static_cast<std::uint16_t>(p + by);
  };
  fast = moved(fast, k_fast_rate), slow = moved(slow, k_slow_rate);
}

RangeCoder::RangeCoder(std::span<const std::uint8_t> bytes) : decoding_(true), bytes_(bytes) {
  for (int i = 0; i < k_tail; ++i) code_ = code_ << 8 | next();
}

std::uint8_t RangeCoder::next() {
  if (at_ < bytes_.size()) return bytes_[at_++];
  failed_ = true;
  return 0;
}

void RangeCoder::shift_low() {
  if (low_ < 0xff000000u || low_ > 0xffffffffu) {
    const auto carry = static_cast<std::uint8_t>(low_ >> 32);
    if (!first_) out_.push_back(static_cast<std::uint8_t>(cache_ + carry));
    first_ = false;
    for (; pending_ > 0; --pending_) out_.push_back(static_cast<std::uint8_t>(0xff + carry));
    cache_ = static_cast<std::uint8_t>(low_ >> 24);
  } else {
    ++pending_;
  }
  low_ = (low_ & 0x00ffffffu) << 8;
}

bool RangeCoder::split(std::uint32_t bound, bool value) {
  if (!decoding_ && !costs_.empty())
    costs_[stream_].bits -= std::log2(double(value ? range_ - bound : bound) / double(range_));
  if (decoding_) {
    value = code_ >= bound;
    if (value) code_ -= bound;
  } else if (value) {
    low_ += bound;
  }
  range_ = value ? range_ - bound : bound;
  while (range_ < k_top) {
    range_ <<= 8;
    if (decoding_)
      code_ = code_ << 8 | next();
    else
      shift_low();
  }
  return value;
}

bool RangeCoder::bit_of(std::uint32_t zero_share, bool value) {
  return split((range_ >> 16) * std::clamp(zero_share, 16u, 65536u - 16u), value);
}

bool RangeCoder::bit(BitModel& model, bool value) {
  value = split((range_ >> 16) * zero_share(model), value);
  model.learn(value);
  return value;
}

void RangeCoder::stream(const char* name) {
  if (decoding_) return;
  if (costs_.empty() || costs_[stream_].name != name) {
    const auto at = std::find_if(costs_.begin(), costs_.end(),
                                 [&](const StreamCost& c) { return std::string_view(c.name) == name; });
    stream_ = static_cast<std::size_t>(at - costs_.begin());
    if (at == costs_.end()) costs_.push_back({.name = name});
  }
  ++costs_[stream_].values;
}

std::uint64_t RangeCoder::limited(std::uint64_t magnitude) {
  if (decoding_ && magnitude > k_most_signed) failed_ = true;
  return std::min(magnitude, k_most_signed);
}

std::uint32_t RangeCoder::plain(int count, std::uint32_t value) {
  std::uint32_t out = 0;
  for (int i = count - 1; i >= 0; --i) out = out << 1 | (split(range_ >> 1, (value >> i & 1) != 0) ? 1u : 0u);
  return out;
}

std::uint64_t RangeCoder::number(NumberModel& model, std::uint64_t value) {
  const int bits = std::bit_width(value);
  std::uint32_t width = 1;
  for (int i = 5; i >= 0; --i) width = width << 1 | (bit(model.width[width], (bits >> i & 1) != 0) ? 1u : 0u);
  width &= 63;
  if (width == 0) return 0;
  std::uint64_t out = 1;
  std::uint32_t prefix = 1;
  for (int i = static_cast<int>(width) - 2; i >= 0; --i) {
    const bool set = (value >> i & 1) != 0;
    const bool got = prefix < (1u << NumberModel::k_learnt) ? bit(model.upper_of(width)[prefix], set)
                                                            : plain(1, set ? 1 : 0) != 0;
    out = out << 1 | (got ? 1u : 0u);
    if (prefix < (1u << NumberModel::k_learnt)) prefix = prefix << 1 | (got ? 1u : 0u);
  }
  return out;
}

std::int64_t RangeCoder::signed_number(SignedModel& model, std::int64_t value) {
  const std::uint64_t size = number(model.magnitude, static_cast<std::uint64_t>(value < 0 ? -value : value));
  bool negative = false;
  if (size != 0) negative = bit(model.sign[static_cast<std::size_t>(model.before)], value < 0);
  model.before = size == 0 ? 0 : negative ? 1 : 2;
  const auto out = static_cast<std::int64_t>(limited(size));
  return negative ? -out : out;
}

std::vector<std::uint8_t> RangeCoder::finish() {
  for (int i = 0; i < k_tail + 1; ++i) shift_low();
  return std::move(out_);
}

}  // namespace copse
