// What lodbake does, stage by stage.
#pragma once

#include "tools/common/tool.h"
#include "tools/lodbake/options.h"

namespace copse::lodbake {

inline constexpr std::size_t k_max_discrete = 64;

Result<void> run(const Options& options, Context& context);

}  // namespace copse::lodbake
