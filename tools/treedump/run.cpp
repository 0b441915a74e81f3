#include "tools/treedump/run.h"

#include "tools/treedump/eco_view.h"
#include "tools/treedump/json.h"
#include "tools/treedump/text.h"
#include "tools/treedump/views.h"

#include <fmt/format.h>

namespace copse {
namespace {

namespace fs = std::filesystem;

Result<void> check_file_count(const DumpOptions& options) {
  const std::size_t wanted = options.diff ? 2 : 1;
  if (options.verify || options.files.size() == wanted) return {};
  return fail(Fault::usage, "", fmt::format("{} files are named, {} wanted", options.files.size(), wanted),
              options.diff ? "name the two files to compare"
                           : "run treedump once a file, or use --verify for several");
}

// Answers go to stdout at once, also when the run then fails; into a file only when it succeeds.
Result<void> answer(const DumpOptions& options, Context& context, const std::string& text) {
  if (options.output != "-") return context.write(options.output, text);
  context.print(text);
  return {};
}

Result<void> describe_ecosystem(const DumpOptions& options, Context& context) {
  const auto text = options.json ? ecosystem_json(options.files.front(), options.arrays)
                                 : ecosystem_text(options.files.front());
  if (!text) return std::unexpected(text.error());
  return answer(options, context, *text);
}

Result<void> describe(const DumpOptions& options, Context& context) {
  if (is_ecosystem(options.files.front())) return describe_ecosystem(options, context);
  Stage stage = context.stage("read");
  const std::vector<std::string> wanted{"PROV", "MATL", "TEXR", "TDAT", "RADI", "TDIA", "TACC"};
  const auto dump = open_dump(options.files.front(), options.arrays ? std::vector<std::string>{} : wanted);
  if (!dump) return std::unexpected(dump.error());
  stage.items(dump->container.size(), "bytes");
  context.report().tables.push_back(sections_table(*dump));
  if (auto done =
          answer(options, context, options.json ? json_text(*dump, options.arrays) : summary_text(*dump));
      !done) {
    return done;
  }
  if (dump->problem) return std::unexpected(*dump->problem);
  return {};
}

Result<void> show_hierarchy(const DumpOptions& options, Context& context) {
  const auto file = TreeFile::open(options.files.front());
  if (!file) return std::unexpected(file.error());
  const auto text = hierarchy_json(*file, options.files.front().string());
  if (!text) return std::unexpected(text.error());
  return context.write(options.output, *text);
}

std::string failures_json(const DumpOptions& options, const std::vector<std::vector<std::string>>& failures);

Result<void> verify_all(const DumpOptions& options, Context& context) {
  std::vector<std::vector<std::string>> failures;
  std::size_t failed = 0, files = 0;
  std::string text;
  for (const fs::path& path : options.files) {
    Stage stage = context.stage(fmt::format("verify {}", path.filename().string()));
    auto found = verify_file(path);
    if (!found) return std::unexpected(found.error());
    failed += found->size();
    files += found->empty() ? 0 : 1;
    for (const std::string& line : *found) text += fmt::format("{}: {}\n", path.string(), line);
    const bool tell = !context.options().quiet;
    if (found->empty() && tell)
      text += fmt::format("{}: every checksum and every invariant holds\n", path.string());
    failures.push_back(std::move(*found));
  }
  if (options.json) text = failures_json(options, failures);
  if (auto done = answer(options, context, text); !done) return done;
  if (failed == 0) return {};
  return refuse(options.files.size() == 1 ? options.files.front().string() : "",
                files == 1 ? fmt::format("{} failed", count_text(failed, "check"))
                           : fmt::format("{} failed in {} files", count_text(failed, "check"), files),
                "restore the file, or make it again");
}

std::string failures_json(const DumpOptions& options, const std::vector<std::vector<std::string>>& failures) {
  JsonText json;
  json.open_object();
  json.member("schema", "copse.verify/1");
  json.key("files");
  json.open_list();
  for (std::size_t i = 0; i < failures.size(); ++i) {
    json.open_object();
    json.member("file", options.files[i].string());
    json.member("sound", failures[i].empty());
    json.key("failures");
    json.open_list();
    for (const std::string& line : failures[i]) json.value(line);
    json.close();
    json.close();
  }
  json.close();
  json.close();
  return json.take();
}

template <class File>
Result<std::pair<File, File>> open_both(const DumpOptions& options) {
  auto a = File::open(options.files[0]);
  if (!a) return std::unexpected(a.error());
  auto b = File::open(options.files[1]);
  if (!b) return std::unexpected(b.error());
  return std::pair{std::move(*a), std::move(*b)};
}

Result<Difference> find_difference(const DumpOptions& options) {
  if (is_ecosystem(options.files[0]) && is_ecosystem(options.files[1])) {
    if (options.tolerance > 0)
      return fail(Fault::usage, "",
                  "--tolerance does not work on ecosystems, whose sections are compared by bytes",
                  "leave it out");
    const auto both = open_both<Container>(options);
    if (!both) return std::unexpected(both.error());
    return diff_containers(both->first, both->second);
  }
  const auto both = open_both<TreeFile>(options);
  if (!both) return std::unexpected(both.error());
  return diff_files(both->first, both->second, options.tolerance);
}

Result<void> show_difference(const DumpOptions& options, Context& context) {
  const auto difference = find_difference(options);
  if (!difference) return std::unexpected(difference.error());
  std::string text;
  for (const std::string& line : difference->lines) text += line + "\n";
  if (!context.options().quiet) {
    for (const std::string& note : difference->notes) text += fmt::format("note: {}\n", note);
    if (difference->lines.empty()) text += "no differences\n";
  }
  if (auto done = answer(options, context, text); !done) return done;
  if (difference->lines.empty()) return {};
  return refuse(options.files[1].string(),
                fmt::format("differs from {} in {}", options.files[0].string(),
                            count_text(difference->lines.size(), "place")),
                "see the list on stdout");
}

Result<void> write_geometry(const DumpOptions& options, Context& context) {
  if (auto writable = context.check_output(options.export_to); !writable) return writable;
  const auto file = TreeFile::open(options.files.front());
  if (!file) return std::unexpected(file.error());
  Stage stage = context.stage("export");
  const auto files = export_tree(*file, options);
  if (!files) return std::unexpected(files.error());
  stage.items(std::uint64_t{file->counts().trunk_triangles} + file->counts().leaf_triangles, "triangles");
  for (const ExportedFile& exported : *files) {
    if (auto done = context.write(options.export_to.parent_path() / exported.name, exported.bytes); !done)
      return done;
  }
  return {};
}

}  // namespace

Result<void> run_treedump(const DumpOptions& options, Context& context) {
  if (auto right = check_file_count(options); !right) return right;
  for (const fs::path& file : options.files) context.read(file, true);
  if (auto writable = context.check_output(options.output); !writable) return writable;
  if (options.verify) return verify_all(options, context);
  if (options.diff) return show_difference(options, context);
  if (options.hierarchy) return show_hierarchy(options, context);
  if (!options.export_to.empty()) return write_geometry(options, context);
  return describe(options, context);
}

}  // namespace copse
