#include "tools/ecogen/run.h"

#include "lib/formats/ecosystem_file.h"
#include "lib/formats/mapped_file.h"
#include "tools/ecogen/build.h"
#include "tools/ecogen/document.h"
#include "tools/ecogen/scene.h"
#include "tools/ecogen/texts.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace copse::ecogen {
namespace {

namespace fs = std::filesystem;

Result<Scene> read_page(const Options& options, Context& context) {
  const auto file = MappedFile::open(options.input);
  if (!file) return std::unexpected(file.error());
  context.read(options.input, true);
  const std::string_view text(reinterpret_cast<const char*>(file->bytes().data()), file->bytes().size());
  const std::string name = options.input.string();
  auto document = parse_document(text, name);
  if (!document) return std::unexpected(document.error());
  for (const std::string& assignment : options.edits)
    if (auto done = edit(*document, assignment); !done) return std::unexpected(done.error());
  if (auto valid = validate(*document, name); !valid) return std::unexpected(valid.error());
  auto scene = read_scene(*document, options.input);
  if (scene && context.options().seed != 0) scene->seed = context.options().seed;
  return scene;
}

std::string provenance(const Report& report) {
  nlohmann::ordered_json json = {{"tool", "ecogen"}, {"version", COPSE_VERSION}};
  json["options"] = nlohmann::ordered_json::object();
  for (const auto& [name, value] : report.options) json["options"][name] = value;
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void tell_left_out(const Built& built, Context& context) {
  Table table{"left out", {"what", "why", "bytes"}, {}};
  for (const LeftOut& l : built.left_out) table.rows.push_back({l.what, l.why, std::to_string(l.bytes)});
  if (!table.rows.empty()) context.report().tables.push_back(std::move(table));
}

Result<void> make(const Options& options, Context& context) {
  if (options.output.extension() != ".eco")
    return fail(Fault::usage, options.output.string(),
                options.output.empty() ? "no output is named" : "is not the name of an ecosystem",
                "add -o NAME.eco");
  if (auto writable = context.check_output(options.output); !writable) return writable;
  auto scene = read_page(options, context);
  if (!scene) return std::unexpected(scene.error());
  auto built =
      build(*scene, {.folder = options.output.parent_path(), .document = options.input, .pack = options.pack},
            context);
  if (!built) return std::unexpected(built.error());
  tell_left_out(*built, context);
  built->eco.provenance = provenance(context.report());
  Stage stage = context.stage("write");
  const auto bytes = encode_ecosystem(built->eco, options.compress ? Encoding::zstd : Encoding::raw);
  if (!bytes) return std::unexpected(bytes.error());
  stage.items(bytes->size(), "bytes");
  return context.write(options.output, {reinterpret_cast<const char*>(bytes->data()), bytes->size()});
}

}  // namespace

Result<void> run(const Options& options, Context& context) {
  if (options.print_schema) return context.write("-", k_schema);
  if (options.print_template) return context.write("-", k_template);
  if (options.input.empty())
    return fail(Fault::usage, "", "no page is named", "name a JSON file; --new prints one to begin with");
  return make(options, context);
}

}  // namespace copse::ecogen
