#include "lib/formats/ecosystem/type_volumes.h"

#include "lib/formats/ecosystem/instance_bounds.h"
#include "lib/formats/little_endian.h"
#include "lib/formats/volumes/volume_numbers.h"

#include <cmath>

#include <fmt/format.h>

namespace copse {
namespace {

struct Record {
  std::uint32_t type = 0, envelope = 0;  // 1: of the envelope
  std::uint32_t kind = 0, numbers = 0;
};
static_assert(sizeof(Record) == k_type_volume_record);

// What a box can be made of: it reaches somewhere along every axis, both ways.
bool is_usable(const Volume<float>& volume) {
  if (!is_sound(volume)) return false;
  for (int a = 0; a < 3; ++a)
    for (const double side : {-1.0, 1.0}) {
      Double3 e;
      e[a] = side;
      if (!std::isfinite(reach_of(volume, e))) return false;
    }
  return true;
}

}  // namespace

EncodedTypeVolumes encode_type_volumes(const std::vector<TreeType>& types) {
  EncodedTypeVolumes out;
  const auto append = [](std::vector<std::uint8_t>& bytes, const auto& value) {
    bytes.resize(bytes.size() + sizeof value);
    put(std::span(bytes), bytes.size() - sizeof value, value);
  };
  for (std::size_t t = 0; t < types.size(); ++t)
    for (const bool envelope : {false, true})
      for (const Volume<float>& v : envelope ? types[t].envelopes : types[t].volumes) {
        const std::vector<float> numbers = numbers_of(v);
        append(out.records,
               Record{static_cast<std::uint32_t>(t), envelope ? 1u : 0u,
                      static_cast<std::uint32_t>(kind_of(v)), static_cast<std::uint32_t>(numbers.size())});
        for (const float n : numbers) append(out.numbers, n);
      }
  return out;
}

RecordFault decode_type_volumes(std::span<const std::uint8_t> records, std::span<const std::uint8_t> numbers,
                                std::vector<TreeType>& types) {
  std::size_t at = 0;
  std::uint64_t before = 0;
  for (std::size_t offset = 0; offset < records.size(); offset += k_type_volume_record) {
    const auto r = get<Record>(records, offset);
    const std::uint64_t order = std::uint64_t{r.type} << 1 | r.envelope;
    if (r.type >= types.size() || r.envelope > 1 || order < before)
      return {offset, fmt::format("type {} is out of range or out of order", r.type)};
    before = order;
    const auto kind = static_cast<VolumeKind>(r.kind);
    if (r.kind >= k_volume_kinds || kind == VolumeKind::kdop || !is_number_count(kind, r.numbers) ||
        r.numbers > numbers.size() / sizeof(float) - at)
      return {offset + 8, fmt::format("kind {} with {} numbers", r.kind, r.numbers)};
    std::vector<float> values(r.numbers);
    for (float& v : values) v = get<float>(numbers, sizeof(float) * at++);
    const Volume<float> volume = volume_of(kind, values);
    if (!is_usable(volume)) return {offset, "numbers that make no volume"};
    (r.envelope ? types[r.type].envelopes : types[r.type].volumes).push_back(volume);
  }
  if (at != numbers.size() / sizeof(float)) return {0, "numbers that belong to no volume"};
  return {};
}

}  // namespace copse
