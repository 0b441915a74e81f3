#include "tools/ecogen/run.h"

#include "lib/formats/container/mapped_file.h"
#include "lib/formats/ecosystem/ecosystem_file.h"
#include "lib/formats/hash.h"
#include "tools/ecogen/build.h"
#include "tools/ecogen/document.h"
#include "tools/ecogen/export_eco.h"
#include "tools/ecogen/instance_table.h"
#include "tools/ecogen/map_legend.h"
#include "tools/ecogen/scene.h"
#include "tools/ecogen/texts.h"
#include "tools/treeplay/path_file.h"

#include <optional>
#include <set>

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
  make_whole(*document);
  if (auto valid = validate(*document, name); !valid) return std::unexpected(valid.error());
  auto scene = read_scene(*document, options.input);
  if (scene && context.options().seed != 0) scene->seed = context.options().seed;
  return scene;
}

// Nothing of the number of threads, of folders or of the time: the same page gives the same bytes. Trees are
// not among the sources: their types have their hashes.
Result<std::string> provenance(const Options& options, const Scene& scene,
                               const std::vector<fs::path>& maps) {
  nlohmann::ordered_json json = {{"tool", "ecogen"}, {"version", COPSE_VERSION}};
  json["options"] = {{"seed", scene.seed},
                     {"pack", options.pack},
                     {"compress", options.compress},
                     {"edit", options.edits},
                     {"view-range", options.view_range}};
  std::vector<fs::path> files{options.input};
  if (!options.instances.empty()) {
    json["options"]["instances"] = options.instances.filename().string();
    files.push_back(options.instances);
  }
  if (!options.camera_path.empty()) {
    json["options"]["camera-path"] = options.camera_path.filename().string();
    json["options"]["widest"] = options.widest;
    json["options"]["lowest-sun"] = options.lowest_sun;
    files.push_back(options.camera_path);
  }
  files.insert(files.end(), maps.begin(), maps.end());
  json["sources"] = nlohmann::ordered_json::array();
  for (const fs::path& file : files) {
    const auto record = hash_file(file);
    if (!record) return std::unexpected(record.error());
    json["sources"].push_back({{"name", file.filename().string()}, {"hash", record->hash}});
  }
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void tell_left_out(const Built& built, Context& context) {
  Table table{"left out", {"what", "why", "bytes of this file", "bytes of others, not to be read"}, {}};
  std::uint64_t here = 0, elsewhere = 0;
  const auto row = [&](const std::string& what, const std::string& why, std::uint64_t a, std::uint64_t b) {
    table.rows.push_back({what, why, std::to_string(a), std::to_string(b)});
  };
  for (const LeftOut& l : built.left_out) {
    row(l.what, l.why, l.bytes, l.bytes_elsewhere);
    here += l.bytes, elsewhere += l.bytes_elsewhere;
  }
  if (table.rows.size() > 1) row("in all", "", here, elsewhere);
  if (!table.rows.empty()) context.report().tables.push_back(std::move(table));
}

Result<void> draw_map(ForestMap& map, Context& context) {
  if (context.options().html.empty()) return {};
  Stage stage = context.stage("map");
  auto picture = map_for_page(map);
  if (!picture) return std::unexpected(picture.error());
  context.report().pictures.push_back(std::move(*picture));
  return {};
}

Result<void> read_instances(const Options& options, Scene& scene, Context& context) {
  if (options.instances.empty()) return {};
  const auto file = MappedFile::open(options.instances);
  if (!file) return std::unexpected(file.error());
  context.read(options.instances, true);
  return add_instances({reinterpret_cast<const char*>(file->bytes().data()), file->bytes().size()},
                       options.instances.string(), scene);
}

// None when no path is named.
Result<std::optional<CameraPath>> read_frames(const Options& options, Context& context) {
  if (options.camera_path.empty()) return std::nullopt;
  auto path = treeplay::read_path(options.camera_path, 1.0);
  if (!path) return std::unexpected(path.error());
  context.read(options.camera_path, true);
  return std::optional(std::move(*path));
}

Result<void> check_outputs(const Options& options, Context& context) {
  if (options.output.extension() != ".eco")
    return fail(Fault::usage, options.output.string(),
                options.output.empty() ? "no output is named" : "is not the name of an ecosystem",
                "add -o NAME.eco");
  if (auto writable = context.check_output(options.output); !writable) return writable;
  std::set<fs::path> names;
  for (const fs::path& file : options.exports) {
    if (auto known = check_export(file); !known) return known;
    if (auto file_writable = context.check_output(file); !file_writable) return file_writable;
    std::error_code error;
    const fs::path name = fs::weakly_canonical(fs::absolute(file), error);
    if (!error && !names.insert(name).second)
      return fail(Fault::usage, file.string(), "two outputs of this run have this name",
                  "give each a name of its own");
  }
  return {};
}

Result<void> write_eco(const Ecosystem& eco, const Options& options, Context& context) {
  Stage stage = context.stage("write");
  const auto bytes = encode_ecosystem(eco, options.compress ? Encoding::zstd : Encoding::raw);
  if (!bytes) return std::unexpected(bytes.error());
  stage.items(bytes->size(), "bytes");
  return context.write(options.output, {reinterpret_cast<const char*>(bytes->data()), bytes->size()});
}

Result<void> make(const Options& options, Context& context) {
  if (auto possible = check_outputs(options, context); !possible) return possible;
  auto scene = read_page(options, context);
  if (!scene) return std::unexpected(scene.error());
  if (auto added = read_instances(options, *scene, context); !added) return added;
  const auto path = read_frames(options, context);
  if (!path) return std::unexpected(path.error());
  auto built = build(*scene,
                     {.folder = options.output.parent_path(),
                      .document = options.input,
                      .path = *path ? &**path : nullptr,
                      .aspect = options.widest,
                      .lowest_sun = options.lowest_sun,
                      .view_range = options.view_range,
                      .pack = options.pack},
                     context);
  if (!built) return std::unexpected(built.error());
  tell_left_out(*built, context);
  ForestMap map(built->eco);
  if (auto drawn = draw_map(map, context); !drawn) return drawn;
  auto told = provenance(options, *scene, built->sources);
  if (!told) return std::unexpected(told.error());
  built->eco.provenance = std::move(*told);
  if (auto done = write_eco(built->eco, options, context); !done) return done;
  for (const fs::path& file : options.exports)
    if (auto done =
            export_ecosystem(built->eco, options.output.parent_path(), file,
                             options.glb_nodes ? Instancing::nodes : Instancing::extension, map, context);
        !done)
      return done;
  return {};
}

}  // namespace

Result<void> run(const Options& options, Context& context) {
  if (options.print_schema && options.print_template)
    return fail(Fault::usage, "", "--new and --schema are asked for at once", "ask for one of them");
  if ((options.print_schema || options.print_template) && options.output.extension() == ".eco")
    return fail(Fault::usage, options.output.string(),
                "is the name of an ecosystem, and this is a page of JSON",
                "name it NAME.json, and make the ecosystem of that");
  if (options.print_schema || options.print_template)
    return context.write(options.output.empty() ? "-" : options.output,
                         options.print_schema ? k_schema : k_template);
  if (options.input.empty())
    return fail(Fault::usage, "", "no page is named", "name a JSON file; --new prints one to begin with");
  return make(options, context);
}

}  // namespace copse::ecogen
