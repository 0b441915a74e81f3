#include "tools/common/command_line.h"

#include "tools/common/help.h"
#include "tools/common/jobs.h"
#include "tools/common/option_groups.h"
#include "tools/common/option_values.h"
#include "tools/common/response_file.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace copse {
namespace {

// The common options and what was made of them.
struct Common {
  CommonOptions values;
  std::string progress = "auto";
  std::string jobs, seed = "0";
  bool asked[3] = {};  // CLI11 wants a place for every flag; count() tells even when the parse fails
  CLI::Option* help = nullptr;
  CLI::Option* version = nullptr;
  CLI::Option* limits = nullptr;
  CLI::Option* config = nullptr;
  std::vector<const CLI::Option*> unrecorded;  // where results go and how to tell of them: not what they are
};

template <class T>
bool parse_whole(std::string_view text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() && !text.empty();
}

// Why a configuration file is not read; empty when it may be. One that is missing is told of by the reader.
std::string config_problem(const std::string& file) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (std::filesystem::is_character_file(status) || std::filesystem::is_block_file(status))
    return fmt::format("{} is a device; name a file", file);
  if (!std::filesystem::is_regular_file(status)) return {};
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (!error && size > k_config_bytes)
    return fmt::format("{} has {} bytes and no more than {} are read; is it the right file?", file, size,
                       k_config_bytes);
  return {};
}

void add_common(CLI::App& app, Common& c) {
  const auto in_group = [](CLI::Option* option) { return option->group(k_common_group); };
  CommonOptions& v = c.values;
  c.help = in_group(app.add_flag("-h,--help", c.asked[0], "show this page and exit"));
  c.version = in_group(app.add_flag("--version", c.asked[1], "show the version and exit"));
  c.limits = in_group(app.add_flag("--limits", c.asked[2], "show every built-in limit and exit"));
  CLI::Option* quiet = in_group(app.add_flag("-q,--quiet", v.quiet, "say nothing but errors"));
  CLI::Option* verbose = in_group(app.add_flag("-v,--verbose", v.verbose, "one line a stage, with its time"));
  quiet->excludes(verbose);
  CLI::Option* progress = in_group(app.add_option("--progress", c.progress,
                                                  "a bar on stderr for what takes more than a second; auto: "
                                                  "only on a terminal")
                                       ->check(CLI::IsMember({"auto", "always", "never"})));
  CLI::Option* jobs = in_group(
      app.add_option("-j,--jobs", c.jobs,
                     "worker threads; default: what the affinity mask, the cgroup and SLURM_CPUS_PER_TASK "
                     "allow; the output is the same for every N")
          ->type_name("N")
          ->check(whole_number_from(1, k_max_jobs)));
  in_group(app.add_option("--seed", c.seed, "seeds every random choice")
               ->type_name("N")
               ->check(whole_number_from(0)));
  CLI::Option* report = in_group(
      app.add_option("--report", v.report, "what was done, how long it took and how wrong it is, as JSON")
          ->type_name("FILE"));
  CLI::Option* html =
      in_group(app.add_option("--html", v.html, "the same as one self-contained page")->type_name("FILE"));
  CLI::Option* depfile =
      in_group(app.add_option("--depfile", v.depfile, "every file that was read, for make or ninja")
                   ->type_name("FILE"));
  c.config = in_group(app.set_config("--config", "", "options from a TOML file; the command line wins"));
  c.config->type_name("FILE")->configurable(false)->check(config_problem);
  for (CLI::Option* option : {c.help, c.version, c.limits}) option->configurable(false);
  c.unrecorded = {c.help, c.version, c.limits, quiet,   verbose, progress,
                  jobs,   report,    html,     depfile, c.config};
}

std::string see_help(const ToolInfo& info) {
  return fmt::format("see `{} --help`", info.name);
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : all_options(app)) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

// What CLI11 could not place: a misspelt option before a superfluous argument.
std::unexpected<Error> unexpected_arguments(const ToolInfo& info, const CLI::App& app,
                                            const std::vector<std::string>& rest) {
  for (const std::string& argument : rest) {
    if (argument.size() < 2 || argument.front() != '-') continue;
    const std::string name = argument.substr(0, argument.find('='));
    const std::string nearest = nearest_name(name, option_names(app));
    const std::string hint = nearest.empty() ? "" : fmt::format("did you mean {}? ", nearest);
    return fail(Fault::usage, "", fmt::format("there is no option {}", name), hint + see_help(info));
  }
  return fail(Fault::usage, "", fmt::format("the argument '{}' is one too many", rest.front()),
              see_help(info));
}

std::string joined(const std::vector<std::string>& values) {
  std::string text;
  for (const std::string& value : values) text += (text.empty() ? "" : ",") + value;
  return text;
}

// The first option whose value is not what its type asks for; CLI11 does not say more than "could not
// convert".
std::string conversion_problem(const CLI::App& app, const CLI::ParseError& error) {
  const std::string what = error.what();
  for (const CLI::Option* option : all_options(app)) {
    if (option->count() == 0 || what.find(option->get_name() + " = ") == std::string::npos) continue;
    return fmt::format("{}: '{}' cannot be read as {}", option->get_name(), joined(option->results()),
                       option->get_type_name());
  }
  return what;
}

// CLI11's messages, told as copse tells them.
std::unexpected<Error> explain(const ToolInfo& info, const CLI::App& app, const Common& common,
                               const CLI::ParseError& error) {
  std::vector<std::string> rest = app.remaining();
  std::erase(rest, "--");
  if (!rest.empty()) return unexpected_arguments(info, app, rest);
  const std::string config = common.config->count() > 0 ? common.config->results().back() : "";
  if (dynamic_cast<const CLI::FileError*>(&error) != nullptr) {
    return fail(Fault::io, config, "cannot read the configuration file",
                "check the path and its permissions");
  }
  if (dynamic_cast<const CLI::ConfigError*>(&error) != nullptr) {
    std::string what = error.what();
    const std::string_view unknown = "INI was not able to parse ";
    if (what.starts_with(unknown)) what = fmt::format("there is no option '{}'", what.substr(unknown.size()));
    return fail(Fault::usage, config, what, "use the long names of the options; " + see_help(info));
  }
  const bool conversion = dynamic_cast<const CLI::ConversionError*>(&error) != nullptr;
  return fail(Fault::usage, "", conversion ? conversion_problem(app, error) : error.what(), see_help(info));
}

std::vector<std::pair<std::string, std::string>> options_for_report(const CLI::App& app,
                                                                    const Common& common) {
  std::vector<std::pair<std::string, std::string>> list;
  for (const CLI::Option* option : all_options(app)) {
    const auto& skip = common.unrecorded;
    if (!option->nonpositional() || std::find(skip.begin(), skip.end(), option) != skip.end()) continue;
    const std::string name =
        option->get_lnames().empty() ? option->get_snames().front() : option->get_lnames().front();
    const bool flag = option->get_expected_min() == 0;
    if (option->count() > 0) {
      list.emplace_back(name, joined(option->reduced_results()));
    } else if (flag) {
      list.emplace_back(name, "false");
    } else if (const std::string value = option->get_default_str();
               !value.empty() && value != "[]" && value != "\"\"") {
      list.emplace_back(name, value);
    }
  }
  list.emplace_back("jobs", std::to_string(common.values.jobs));
  return list;
}

void settle(Common& common) {
  CommonOptions& v = common.values;
  v.progress = common.progress == "always"  ? Progress::always
               : common.progress == "never" ? Progress::never
                                            : Progress::automatic;
  if (common.jobs.empty()) {
    v.jobs = default_jobs();
  } else {
    parse_whole(common.jobs, v.jobs);
  }
  parse_whole(common.seed, v.seed);
}

// Edits (insert, delete, replace, swap of neighbours) that turn a into b.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

}  // namespace

std::string nearest_name(const std::string& given, const std::vector<std::string>& names) {
  if (given.size() <= 3 || given.size() > 64) return {};  // nothing to go by; no option is that long
  std::string best;
  std::size_t least = std::max<std::size_t>(2, given.size() / 3) + 1;
  for (const std::string& name : names) {
    // The beginning of a long name is as good as a small slip.
    const bool begins = name.starts_with(given);
    const std::size_t edits = begins ? 1 : edit_distance(given, name);
    if (edits < least && edits < given.size()) {
      least = edits;
      best = name;
    }
  }
  return best;
}

Result<CommandLine> parse_command_line(const ToolInfo& info, const std::vector<std::string>& arguments,
                                       const AddOptions& add_options, int width) {
  auto expanded = expand_response_files(arguments);
  if (!expanded) return std::unexpected(std::move(expanded.error()));
  CLI::App app(info.summary, info.name);
  app.set_help_flag();
  app.allow_extras();
  app.allow_config_extras(CLI::config_extras_mode::error);
  app.option_defaults()->always_capture_default()->take_last();
  if (add_options) add_options(app);
  Common common;
  add_common(app, common);

  std::vector<std::string> reversed(expanded->arguments.rbegin(), expanded->arguments.rend());
  Result<void> parsed;
  try {
    app.parse(std::move(reversed));
    std::vector<std::string> rest = app.remaining();
    std::erase(rest, "--");
    if (!rest.empty()) parsed = unexpected_arguments(info, app, rest);
  } catch (const CLI::ParseError& error) {
    parsed = explain(info, app, common, error);
  }

  CommandLine line;
  line.files = std::move(expanded->files);
  // Whoever asks for help gets it, whatever else is wrong.
  if (common.help->count() > 0) {
    line.answer = help_text(info, app, width);
  } else if (common.version->count() > 0) {
    line.answer = fmt::format("{} {}\n", info.name, COPSE_VERSION);
  } else if (common.limits->count() > 0) {
    line.answer = limits_text(info);
  } else if (!parsed) {
    return std::unexpected(std::move(parsed.error()));
  } else {
    settle(common);
    line.common = std::move(common.values);
    line.options = options_for_report(app, common);
    for (const std::string& file : common.config->results()) line.files.emplace_back(file);
  }
  return line;
}

}  // namespace copse
