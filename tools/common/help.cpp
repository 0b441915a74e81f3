#include "tools/common/help.h"

#include "tools/common/jobs.h"
#include "tools/common/option_groups.h"
#include "tools/common/response_file.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace copse {
namespace {

constexpr int k_narrowest = 40;
constexpr int k_widest = 110;
constexpr std::size_t k_widest_label = 30;

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    if (end > 0) words.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return words;
}

// The words of a command; blanks inside quotes do not part it.
std::vector<std::string> command_words(std::string_view text) {
  std::vector<std::string> words(1);
  char quote = 0;
  for (const char c : text) {
    if (quote == 0 && c == ' ') {
      if (!words.back().empty()) words.emplace_back();
      continue;
    }
    if (quote == 0 && (c == '\'' || c == '"')) {
      quote = c;
    } else if (c == quote) {
      quote = 0;
    }
    words.back() += c;
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

// Lines of at most `width` columns without line breaks; a word that is longer stands alone.
std::vector<std::string> fill_lines(std::vector<std::string> words, std::size_t width) {
  std::vector<std::string> lines;
  for (std::string& word : words) {
    if (!lines.empty() && lines.back().size() + 1 + word.size() <= width) {
      lines.back() += " " + word;
    } else {
      lines.push_back(std::move(word));
    }
  }
  return lines;
}

// Breaks lines where the text does, and where they grow too long.
std::vector<std::string> wrapped(std::string_view text, std::size_t width) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    for (std::string& line : fill_lines(words_of(text.substr(0, end)), width))
      lines.push_back(std::move(line));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

// CLI11 puts the checks of an option behind its type: "TEXT:{auto,always}". A closed set says more than the
// type does; other checks are the business of the description.
std::string value_name(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t set = type.find(":{");
  const std::size_t end = type.find('}', set == std::string::npos ? 0 : set);
  if (set != std::string::npos && end != std::string::npos) {
    std::string names = type.substr(set + 2, end - set - 2);
    std::replace(names.begin(), names.end(), ',', '|');
    return names;
  }
  return type.substr(0, type.find(':'));
}

std::string ellipsis(const CLI::Option& option) {
  return option.get_items_expected_max() > 1 && !option.get_type_name().ends_with("...") ? "..." : "";
}

std::string label_of(const CLI::Option& option) {
  if (option.nonpositional()) {
    std::string label = option.get_snames().empty() ? "    " : "-" + option.get_snames().front();
    for (std::size_t i = 1; i < option.get_snames().size(); ++i) label += ", -" + option.get_snames()[i];
    for (const std::string& name : option.get_lnames()) {
      label += (label == "    " ? "--" : ", --") + name;
    }
    if (option.get_items_expected_max() == 0 || option.get_expected_min() == 0) return label;
    return label + " " + value_name(option) + ellipsis(option);
  }
  return option.get_name(true) + ellipsis(option);
}

std::string without_quotes(std::string text) {
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  return text;
}

std::string description_of(const CLI::Option& option) {
  std::string text = option.get_description();
  const std::string value = without_quotes(option.get_default_str());
  if (!value.empty() && value != "[]" && option.get_expected_min() != 0) text += " [" + value + "]";
  return text;
}

void add_entry(std::string& out, const std::string& label, const std::string& description, std::size_t column,
               std::size_t width) {
  const std::vector<std::string> lines = wrapped(description, width - column);
  out += "  " + label;
  std::size_t at = 2 + label.size();
  if (at + 2 > column) {
    out += "\n";
    at = 0;
  }
  for (const std::string& line : lines) {
    out += std::string(column - at, ' ') + line + "\n";
    at = 0;
  }
  if (lines.empty()) out += "\n";
}

// An example that is too long for a line goes on as a shell would have it.
void add_example(std::string& out, const std::string& command, const std::string& meaning,
                 std::size_t width) {
  const std::vector<std::string> lines = fill_lines(command_words(command), width - 8);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    out += (i == 0 ? "  " : "      ") + lines[i] + (i + 1 < lines.size() ? " \\\n" : "\n");
  }
  for (const std::string& line : wrapped(meaning, width - 6)) out += "      " + line + "\n";
}

std::vector<const CLI::Option*> those(const std::vector<const CLI::Option*>& options, bool positional) {
  std::vector<const CLI::Option*> found;
  for (const CLI::Option* option : options) {
    if (option->nonpositional() != positional) found.push_back(option);
  }
  return found;
}

void add_group(std::string& out, const std::string& title, const std::vector<const CLI::Option*>& options,
               std::size_t column, std::size_t width) {
  if (options.empty()) return;
  out += "\n" + title + ":\n";
  for (const CLI::Option* option : options) {
    add_entry(out, label_of(*option), description_of(*option), column, width);
  }
}

std::string usage_line(const ToolInfo& info, const CLI::App& app) {
  std::string usage = "Usage: " + info.name + " [OPTIONS]";
  for (const CLI::Option* option : all_options(app)) {
    if (!option->nonpositional()) {
      const std::string name = option->get_name(true) + ellipsis(*option);
      usage += option->get_required() ? " " + name : " [" + name + "]";
    } else if (option->get_required()) {
      usage += " " + (option->get_snames().empty() ? "--" + option->get_lnames().front()
                                                   : "-" + option->get_snames().front());
      usage += " " + value_name(*option);
    }
  }
  return usage;
}

}  // namespace

std::string help_text(const ToolInfo& info, const CLI::App& app, int width) {
  const auto columns = static_cast<std::size_t>(std::clamp(width, k_narrowest, k_widest));
  std::size_t label = 0;
  for (const CLI::Option* option : all_options(app)) {
    const std::size_t size = label_of(*option).size();
    if (size <= k_widest_label) label = std::max(label, size);
  }
  const std::size_t column = std::min(label + 4, columns * 2 / 5);
  std::string out;
  for (const std::string& line : wrapped(info.name + ": " + info.summary, columns)) out += line + "\n";
  out += "\n";
  const std::vector<std::string> usage = wrapped(usage_line(info, app), columns - 4);
  for (std::size_t i = 0; i < usage.size(); ++i) out += (i == 0 ? "" : "    ") + usage[i] + "\n";
  add_group(out, "Arguments", those(all_options(app), true), column, columns);
  for (const OptionGroup& group : option_groups(app)) {
    add_group(out, group.title, those(group.options, false), column, columns);
  }
  out += "\nExamples:\n";
  for (const auto& [command, meaning] : info.examples) add_example(out, command, meaning, columns);
  return out;
}

std::string limits_text(const ToolInfo& info) {
  std::vector<Limit> limits = info.limits;
  limits.push_back({"threads (--jobs)", k_max_jobs, "threads"});
  limits.push_back({"nesting of response files (@FILE)", k_response_depth, "files"});
  limits.push_back({"size of all response files", k_response_bytes, "bytes"});
  limits.push_back({"size of a configuration file", k_config_bytes, "bytes"});
  limits.push_back({"arguments after response files", k_response_args, "arguments"});
  std::size_t name = 0, digits = 0;
  for (const Limit& limit : limits) {
    name = std::max(name, limit.name.size());
    digits = std::max(digits, std::to_string(limit.value).size());
  }
  std::string out;
  for (const Limit& limit : limits) {
    out += fmt::format("{:<{}}  {:>{}} {}\n", limit.name, name, limit.value, digits, limit.unit);
  }
  return out;
}

}  // namespace copse
