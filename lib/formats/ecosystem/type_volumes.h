// The bounding volumes of an ecosystem's types as sections: EVOL says which type, which motion, which kind;
// EVNM has the numbers. docs/formats.md gives the bytes.
#pragma once

#include "lib/formats/ecosystem/ecosystem.h"
#include "lib/formats/materials.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

inline constexpr std::size_t k_type_volume_record = 16;

struct EncodedTypeVolumes {
  std::vector<std::uint8_t> records, numbers;
};
EncodedTypeVolumes encode_type_volumes(const std::vector<TreeType>& types);

// Fills `volumes` and `envelopes` of every type. Precondition: whole records, whole float32. What is wrong
// and where in EVOL, or nothing.
RecordFault decode_type_volumes(std::span<const std::uint8_t> records, std::span<const std::uint8_t> numbers,
                                std::vector<TreeType>& types);

}  // namespace copse
