// Every option of a tool, under the titles of --help. CLI11 keeps the options of an option group apart from
// those of the application, and what asks the application alone (help, report, "did you mean") would never
// hear of them.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace copse {

inline constexpr const char* k_common_group = "Common options";

struct OptionGroup {
  std::string title;
  std::vector<const CLI::Option*> options;  // and positional arguments, in the order in which they were added
};

// The tool's own options first, group by group, the common ones last; hidden options are in none.
std::vector<OptionGroup> option_groups(const CLI::App& app);

std::vector<const CLI::Option*> all_options(const CLI::App& app);

}  // namespace copse
