#include "tools/treegrow/run.h"

#include "lib/formats/container/mapped_file.h"
#include "lib/formats/export/export.h"
#include "lib/formats/import/image.h"
#include "tools/treegrow/art.h"
#include "tools/treegrow/join_faces.h"
#include "tools/treegrow/species_toml.h"
#include "tools/treegrow/treegrow.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <zlib.h>

namespace copse::treegrow {
namespace {

using namespace grow;  // NOLINT: the tool is a thin skin over it

Result<void> say(Context& context, const std::string& text) {
  return context.write("-", text);
}

std::string species_list() {
  std::string text;
  for (const std::string& name : species_names())
    text += fmt::format("{:<8} {}\n", name, find_species(name)->summary);
  return text;
}

std::string break_list() {
  std::string text;
  for (const BreakInfo& info : break_table()) text += fmt::format("{:<21} {}\n", info.name, info.what);
  return text;
}

Result<Species> built_in(const std::string& name) {
  auto species = find_species(name);
  if (species) return std::move(*species);
  return fail(Fault::usage, "", "there is no species called '" + name + "'",
              fmt::format("choose one of {}, or give --params FILE", fmt::join(species_names(), ", ")));
}

Result<Species> chosen_species(const Options& options, Context& context) {
  if (options.params.empty() == options.species.empty())
    return fail(Fault::usage, "",
                options.species.empty() ? "no species is named" : "a species is named twice",
                "give SPECIES or --params FILE; --list shows the species");
  if (options.params.empty()) return built_in(options.species);
  const auto file = MappedFile::open(options.params);
  if (!file) return std::unexpected(file.error());
  context.read(options.params, true);
  return species_from_toml({reinterpret_cast<const char*>(file->bytes().data()), file->bytes().size()},
                           options.params.string());
}

Result<Breaks> chosen_breaks(const Options& options) {
  if (options.strict_model) return Breaks{};
  return options.breaks.empty() ? artist_breaks() : parse_breaks(options.breaks);
}

// Paints the textures into the mesh; what has one is drawn in the texture's colours.
Result<void> add_textures(const Order& order, int size, Mesh& mesh) {
  const auto images = paint(order, mesh.materials.size(), size);
  for (std::size_t i = 0; i < images.size(); ++i) {
    auto png = encode_png(images[i]);
    if (!png) return std::unexpected(png.error());
    Material& material = mesh.materials[i];
    material.texture = static_cast<std::uint32_t>(mesh.textures.size());
    material.diffuse = {1, 1, 1};
    material.ambient = {0.4f, 0.4f, 0.4f};
    if (images[i].has_alpha) material.alpha_cutoff = 0.5f;
    mesh.textures.push_back({"", "image/png", std::move(*png)});
  }
  return {};
}

Result<void> write_mesh(const Order& order, const Options& options, ExportFormat format, const Mesh& mesh,
                        Context& context) {
  Stage stage = context.stage("export");
  stage.items(mesh.triangles.size(), "triangles");
  auto files = export_mesh(mesh, format, options.output.filename().string());
  if (!files) return std::unexpected(files.error());
  if (format == ExportFormat::obj) files->front().bytes = join_faces(std::move(files->front().bytes), mesh);
  if (format != ExportFormat::obj && order.breaks.has(Break::quads) && !options.breaks.empty())
    context.warn("only OBJ holds faces of more than three corners: quads are written as triangles");
  const auto folder = options.output.parent_path();
  for (const ExportedFile& file : *files)
    if (const auto done = context.write(folder / file.name, file.bytes); !done) return done;
  return {};
}

// gzip, without name and time: the same bytes every time.
std::string gzipped(const std::string& text) {
  z_stream z{};
  deflateInit2(&z, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY);
  std::string out(deflateBound(&z, text.size()) + 32, '\0');
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));  // zlib reads only
  z.next_out = reinterpret_cast<Bytef*>(out.data());
  z.avail_in = static_cast<uInt>(text.size());
  z.avail_out = static_cast<uInt>(out.size());
  deflate(&z, Z_FINISH);
  out.resize(z.total_out);
  deflateEnd(&z);
  return out;
}

Result<void> write_truth(const Options& options, Truth& truth, Context& context) {
  Stage stage = context.stage("truth");
  stage.items(truth.rings.size(), "rings");
  truth.mesh = options.output.filename().string();
  const std::string json = to_json(truth);
  return context.write(options.truth, options.truth.extension() == ".gz" ? gzipped(json) : json);
}

void tell(const Order& order, const Plan& plan, const Grown& grown, Context& context) {
  Table table{"tree", {"species", "stems", "rings", "leaves", "trunk triangles", "triangles", "breaks"}, {}};
  table.rows.push_back({order.species.name, std::to_string(plan.skeleton.stems.size()),
                        std::to_string(grown.truth.rings.size()), std::to_string(plan.layout.leaves),
                        std::to_string(plan.layout.trunk_triangles),
                        std::to_string(grown.mesh.triangles.size()),
                        fmt::format("{}", fmt::join(order.breaks.names(), ","))});
  context.report().tables.push_back(std::move(table));
}

bool is_truth_name(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  return path == "-" || name.ends_with(".json") || name.ends_with(".json.gz");
}

// Before long work: what cannot be written is not grown.
Result<void> check_outputs(const Options& options, Context& context) {
  if (auto possible = context.check_output(options.output); !possible || options.truth.empty())
    return possible;
  if (is_truth_name(options.truth)) return context.check_output(options.truth);
  return fail(Fault::usage, options.truth.string(), "its extension names no format of a truth file",
              "name it NAME.json or NAME.json.gz");
}

Result<void> grow_and_write(const Options& options, Context& context) {
  if (options.output.empty())
    return fail(Fault::usage, "", "no output is named", "add -o NAME.obj, NAME.glb or NAME.ply");
  const auto format = export_format_of(options.output.filename().string());
  if (!format) return std::unexpected(format.error());
  auto species = chosen_species(options, context);
  if (!species) return std::unexpected(species.error());
  const auto breaks = chosen_breaks(options);
  if (!breaks) return std::unexpected(breaks.error());
  if (auto possible = check_outputs(options, context); !possible) return possible;
  const Order order{std::move(*species), context.options().seed, options.height, options.triangles, *breaks};

  Result<Plan> plan = [&] {
    Stage stage = context.stage("grow");
    auto result = make_plan(order);
    if (result) stage.items(result->skeleton.stems.size(), "stems");
    return result;
  }();
  if (!plan) return std::unexpected(plan.error());
  Grown grown = [&] {
    Stage stage = context.stage("mesh");
    stage.items(total_triangles(plan->layout, order.breaks), "triangles");
    return make_mesh(order, *plan);
  }();
  tell(order, *plan, grown, context);
  if (!options.no_textures && *format != ExportFormat::ply) {  // a PLY names no material
    Stage stage = context.stage("paint");
    if (const auto done = add_textures(order, options.texture_size, grown.mesh); !done) return done;
  }
  if (const auto done = write_mesh(order, options, *format, grown.mesh, context); !done) return done;
  if (options.truth.empty()) return {};
  return write_truth(options, grown.truth, context);
}

}  // namespace

Result<void> run(const Options& options, Context& context) {
  if (options.list) return say(context, species_list());
  if (options.list_breaks) return say(context, break_list());
  if (options.print.empty()) return grow_and_write(options, context);
  const auto species = built_in(options.print);
  if (!species) return std::unexpected(species.error());
  return say(context, to_toml(*species));
}

}  // namespace copse::treegrow
