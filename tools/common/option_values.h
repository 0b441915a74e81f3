// What option values may be, told in copse's words. CLI11's own checks let NaN pass, print bounds with 300
// digits and take the number of an enumerator for its name.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

namespace copse {

// A finite number, in the C locale, whatever the user's.
CLI::Validator number_above(double least);
CLI::Validator number_from(double least);
CLI::Validator number_between(double least, double most);
// A whole number, without sign, exponent or point.
CLI::Validator whole_number_from(std::uint64_t least, std::uint64_t most = UINT64_MAX);

// An option that is one of a closed set of names; the report keeps the name. `value` holds the default.
template <class Value>
CLI::Option* add_choice(CLI::App& app, const std::string& option, Value& value,
                        const std::string& description,
                        const std::vector<std::pair<std::string, Value>>& choices) {
  std::vector<std::string> names;
  std::string given;
  for (const auto& [name, meaning] : choices) {
    names.push_back(name);
    if (meaning == value) given = name;
  }
  const auto set = [&value, choices](const std::string& wanted) {
    for (const auto& [name, meaning] : choices) {
      if (name == wanted) value = meaning;
    }
  };
  return app.add_option_function<std::string>(option, set, description)
      ->check(CLI::IsMember(std::move(names)))
      ->default_str(given);
}

}  // namespace copse
