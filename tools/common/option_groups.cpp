#include "tools/common/option_groups.h"

#include <algorithm>
#include <utility>

#include <CLI/CLI.hpp>

namespace copse {
namespace {

void add_options_of(const CLI::App& app, const std::string& title, std::vector<OptionGroup>& groups) {
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;
    const std::string& name = title.empty() ? option->get_group() : title;
    auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g.title == name; });
    if (group == groups.end()) group = groups.insert(groups.end(), {name, {}});
    group->options.push_back(option);
  }
}

}  // namespace

std::vector<OptionGroup> option_groups(const CLI::App& app) {
  std::vector<OptionGroup> groups;
  add_options_of(app, "", groups);
  for (const CLI::App* group : app.get_subcommands([](const CLI::App* a) { return a->get_name().empty(); })) {
    add_options_of(*group, group->get_group(), groups);
  }
  std::stable_partition(groups.begin(), groups.end(),
                        [](const OptionGroup& g) { return g.title != k_common_group; });
  return groups;
}

std::vector<const CLI::Option*> all_options(const CLI::App& app) {
  std::vector<const CLI::Option*> all;
  for (const OptionGroup& group : option_groups(app)) {
    all.insert(all.end(), group.options.begin(), group.options.end());
  }
  return all;
}

}  // namespace copse
