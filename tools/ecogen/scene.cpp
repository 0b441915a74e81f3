#include "tools/ecogen/scene.h"

#include "tools/common/command_line.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace copse::ecogen {
namespace {

namespace fs = std::filesystem;

// A refusal from deep inside; caught in read_scene, the only door.
struct Refusal {
  std::string what, remedy;
};

[[noreturn]] void refuse_at(const std::string& path, const std::string& what, const std::string& remedy) {
  throw Refusal{path + ": " + what, remedy};
}

class Reader {
 public:
  Reader(const Json& document, const fs::path& file) : root_(document), folder_(file.parent_path()) {}

  Scene read() {
    Scene s;
    s.seed = root_.value("seed", std::uint64_t{0});
    s.exact = root_.value("encoding", "packed") == "exact";
    s.depth = root_.value("hierarchy_depth", k_none);
    for (const Json& tree : root_.value("block_trees", Json::array()))
      (tree == "kd" ? s.kd_tree : s.rtree) = true;
    if (root_.contains("area")) s.area = area(root_["area"]);
    if (root_.contains("materials")) materials(root_["materials"], s);
    if (root_.contains("terrain")) terrain(root_["terrain"], s);
    for (std::size_t i = 0; i < root_["types"].size(); ++i) s.types.push_back(type(root_["types"][i], i));
    check_names(s);
    for (std::size_t i = 0; i < s.types.size(); ++i) avoid(root_["types"][i], i, s);
    if (root_.contains("mixes"))
      for (std::size_t i = 0; i < root_["mixes"].size(); ++i) s.mixes.push_back(mix(root_["mixes"][i], i, s));
    return s;
  }

 private:
  static Double3 point(const Json& j) { return {j[0].get<double>(), j[1].get<double>(), j[2].get<double>()}; }
  static Float3 colour(const Json& j) { return to_float(point(j)); }
  fs::path file(const Json& j) const { return folder_ / j.get<std::string>(); }

  PlantedArea area(const Json& j) const {
    const PlantedArea a{j[0].get<double>(), j[1].get<double>(), j[2].get<double>(), j[3].get<double>()};
    if (!(a.x0 < a.x1 && a.z0 < a.z1))
      refuse_at("area", "holds nothing", "write x0, z0, x1, z1 with x0 < x1 and z0 < z1");
    return a;
  }

  MapSource map(const Json& j) const {
    if (j.is_string()) return {.file = file(j), .channel = {}};
    MapSource m{
        .file = file(j["file"]), .channel = {}, .low = j.value("low", 0.0), .high = j.value("high", 1.0)};
    if (j.contains("channel"))
      m.channel = j["channel"].is_string() ? j["channel"].get<std::string>()
                                           : std::to_string(j["channel"].get<int>());
    return m;
  }
  std::optional<MapSource> map(const Json& j, const char* key) const {
    return j.contains(key) ? std::optional(map(j[key])) : std::nullopt;
  }

  // A number m is `low(m)` to m.
  static ValueRange range(const Json& j, const std::string& path, double from) {
    if (j.is_number()) {
      const double m = j.get<double>();
      return {std::min(from * m, m), std::max(from * m, m)};
    }
    ValueRange r;
    r.min = j.value("min", r.min);
    r.max = j.value("max", r.max);
    if (r.min > r.max)
      refuse_at(path + ".max", fmt::format("{} is below min, {}", r.max, r.min), "swap them, or mend one");
    return r;
  }

  void materials(const Json& list, Scene& s) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      const Json& j = list[i];
      Material m;
      m.name = j["name"].get<std::string>();
      if (!names_.try_emplace(m.name, static_cast<std::uint32_t>(i)).second)
        refuse_at(fmt::format("materials[{}].name", i),
                  fmt::format("'{}' is the name of another material", m.name), "give each its own");
      if (j.contains("ambient")) m.ambient = colour(j["ambient"]);
      if (j.contains("diffuse")) m.diffuse = colour(j["diffuse"]);
      if (j.contains("specular")) m.specular = colour(j["specular"]);
      if (j.contains("emission")) m.emission = colour(j["emission"]);
      m.shininess = j.value("shininess", 0.0f);
      m.alpha = j.value("alpha", 1.0f);
      m.alpha_cutoff = j.value("alpha_cutoff", 0.0f);
      m.double_sided = j.value("double_sided", false);
      if (j.contains("texture")) m.texture = texture(file(j["texture"]), s);
      s.materials.push_back(std::move(m));
    }
  }

  static std::uint32_t texture(const fs::path& path, Scene& s) {
    const auto at = std::find(s.textures.begin(), s.textures.end(), path);
    if (at != s.textures.end()) return static_cast<std::uint32_t>(at - s.textures.begin());
    s.textures.push_back(path);
    return static_cast<std::uint32_t>(s.textures.size() - 1);
  }

  std::uint32_t material(const Json& j, const char* key, const std::string& path) const {
    if (!j.contains(key)) return k_none;
    const auto name = j[key].get<std::string>();
    const auto at = names_.find(name);
    if (at != names_.end()) return at->second;
    std::vector<std::string> known;
    for (const auto& [k, index] : names_) known.push_back(k);
    const std::string nearest = nearest_name(name, known);
    refuse_at(path + "." + key, fmt::format("there is no material called '{}'", name),
              nearest.empty() ? "add it to materials" : fmt::format("did you mean '{}'?", nearest));
  }

  void terrain(const Json& j, Scene& s) {
    TerrainPlan& t = s.terrain;
    if (j.contains("origin")) t.origin = point(j["origin"]);
    if (j.contains("size")) t.width = j["size"][0].get<double>(), t.depth = j["size"][1].get<double>();
    s.height_map = map(j, "height_map");
    const bool shaped = j.contains("nurbs") || j.contains("faults") || s.height_map;
    t.columns = t.rows = shaped ? 257 : 2;
    if (j.contains("samples"))
      t.columns = j["samples"][0].get<std::uint32_t>(), t.rows = j["samples"][1].get<std::uint32_t>();
    if (j.contains("nurbs")) nurbs(j["nurbs"], t);
    if (s.height_map && (t.surface || t.heights))
      refuse_at("terrain", "has a height_map and a nurbs", "keep one of them");
    if (j.contains("faults")) {
      const Json& f = j["faults"];
      t.faults = {f["count"].get<std::uint32_t>(), f["first"].get<double>(), f.value("last", 0.0),
                  f.value("smooth", 0u)};
    }
    s.terrain_material = material(j, "material", "terrain");
    s.texture_size = j.value("texture_size", 4.0);
  }

  // u and v of a surface are x and z of the page.
  static std::string as_written(std::string text) {
    for (const auto& [theirs, ours] : {std::pair("knots_u", "knots_x"), {"knots_v", "knots_z"}})
      for (std::size_t at = text.find(theirs); at != std::string::npos; at = text.find(theirs, at))
        text.replace(at, std::string_view(theirs).size(), ours);
    return text;
  }

  static void nurbs(const Json& j, TerrainPlan& t) {
    const std::string path = "terrain.nurbs";
    if (j.contains("heights") == j.contains("points"))
      refuse_at(path, "needs heights or points, and not both", "give one of them");
    const bool free = j.contains("points");
    const Json& net = j[free ? "points" : "heights"];
    NurbsSurface n;
    n.count_u = net[0].size();
    n.count_v = net.size();
    n.degree_u = static_cast<int>(std::min<std::size_t>(3, n.count_u - 1));
    n.degree_v = static_cast<int>(std::min<std::size_t>(3, n.count_v - 1));
    if (j.contains("degree")) n.degree_u = j["degree"][0].get<int>(), n.degree_v = j["degree"][1].get<int>();
    const auto rectangular = [&](const Json& rows, const char* key) {
      for (std::size_t r = 0; r < rows.size(); ++r)
        if (rows[r].size() != n.count_u)
          refuse_at(
              fmt::format("{}.{}[{}]", path, key, r),
              fmt::format("has {} elements, the first row of the net has {}", rows[r].size(), n.count_u),
              "make all rows equally long");
      if (rows.size() != n.count_v)
        refuse_at(fmt::format("{}.{}", path, key),
                  fmt::format("has {} rows, the net has {}", rows.size(), n.count_v), "give one a row");
    };
    rectangular(net, free ? "points" : "heights");
    for (const Json& row : net)
      for (const Json& v : row) n.points.push_back(free ? point(v) : Double3{0, v.get<double>(), 0});
    if (j.contains("weights")) {
      if (!free)
        refuse_at(path + ".weights", "heights are never weighted, because their grid would bend",
                  "give points instead of heights");
      rectangular(j["weights"], "weights");
      for (const Json& row : j["weights"])
        for (const Json& v : row) n.weights.push_back(v.get<double>());
    }
    const auto knots = [&](const char* key, std::size_t count, int degree) {
      if (j.contains(key)) return j[key].get<std::vector<double>>();
      return count > static_cast<std::size_t>(degree) ? clamped_knots(count, degree) : std::vector<double>();
    };
    n.knots_u = knots("knots_x", n.count_u, n.degree_u);
    n.knots_v = knots("knots_z", n.count_v, n.degree_v);
    if (const std::string wrong = fault_of(n); !wrong.empty())
      refuse_at(path, as_written(wrong), "mend the surface");
    (free ? t.surface : t.heights) = std::move(n);
  }

  TypeSource type(const Json& j, std::size_t index) const {
    const std::string path = fmt::format("types[{}]", index);
    TypeSource t;
    t.tree = file(j["tree"]);
    t.name = j.value("name", t.tree.stem().string());
    t.count = j.value("count", std::uint64_t{0});
    if (j.contains("head")) t.head = range(j["head"], path + ".head", 0);
    if (j.contains("tilt")) tilt(j["tilt"], path + ".tilt", t);
    if (j.contains("scale")) t.scale = range(j["scale"], path + ".scale", 1);
    t.scale_map = map(j, "scale_map");
    if (t.scale_map && !(t.scale.min < t.scale.max))
      refuse_at(path + ".scale_map", "scale has no range that it could choose from",
                "give scale a min and a max, such as {\"min\": 0.5, \"max\": 1}");
    if (j.contains("tint_map")) t.tint_map = file(j["tint_map"]);
    t.trunk_material = material(j, "trunk_material", path);
    t.leaf_material = material(j, "leaf_material", path);
    t.motion = j.value("motion", 0u);
    t.density = map(j, "density");
    t.forbidden = map(j, "forbidden");
    if (j.contains("slope")) t.slope = range(j["slope"], path + ".slope", 0);
    if (j.contains("altitude")) t.altitude = range(j["altitude"], path + ".altitude", 0);
    if (j.contains("distance")) {
      t.distance_map = map(j["distance"]["map"]);
      t.distance = range(j["distance"], path + ".distance", 0);
    }
    if (j.contains("clusters"))
      t.clusters = {j["clusters"]["count"].get<std::uint32_t>(), j["clusters"]["radius"].get<double>()};
    if (j.contains("footprint") && j["footprint"].is_number()) {
      t.crown_footprint = false;
      t.footprint = j["footprint"].get<double>();
    }
    t.spacing = j.value("spacing", 0.0);
    t.fewer = j.value("fewer", false);
    t.view_range = j.value("view_range", 0.0);
    if (j.contains("instances"))
      for (std::size_t i = 0; i < j["instances"].size(); ++i)
        t.planted.push_back(planted(j["instances"][i], fmt::format("{}.instances[{}]", path, i), t));
    return t;
  }

  static void tilt(const Json& j, const std::string& path, TypeSource& t) {
    if (j.is_string()) {
      t.tilt_to_ground = j == "terrain";
      return;
    }
    if (j.contains("pitch")) t.pitch = range(j["pitch"], path + ".pitch", -1);
    if (j.contains("roll")) t.roll = range(j["roll"], path + ".roll", -1);
  }

  PlantedSource planted(const Json& j, const std::string& path, const TypeSource& t) const {
    PlantedSource p;
    p.x = j["x"].get<double>(), p.z = j["z"].get<double>();
    if (j.contains("y")) p.y = j["y"].get<double>();
    p.head = j.value("head", 0.0);
    if (j.contains("pitch")) p.pitch = j["pitch"].get<double>();
    if (j.contains("roll")) p.roll = j["roll"].get<double>();
    p.scale = j.value("scale", 1.0);
    p.trunk_material = j.contains("trunk_material") ? material(j, "trunk_material", path) : t.trunk_material;
    p.leaf_material = j.contains("leaf_material") ? material(j, "leaf_material", path) : t.leaf_material;
    p.motion = j.value("motion", t.motion);
    if (j.contains("tint"))
      for (std::size_t c = 0; c < 3; ++c) p.tint[c] = j["tint"][c].get<std::uint8_t>();
    return p;
  }

  void check_names(const Scene& s) const {
    for (std::size_t i = 0; i < s.types.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (s.types[i].name == s.types[k].name)
          refuse_at(fmt::format("types[{}].name", i),
                    fmt::format("'{}' is the name of types[{}] as well", s.types[i].name, k),
                    "give each its own name");
  }

  static std::size_t type_called(const std::string& name, const std::string& path, const Scene& s) {
    const auto at =
        std::find_if(s.types.begin(), s.types.end(), [&](const TypeSource& t) { return t.name == name; });
    if (at != s.types.end()) return static_cast<std::size_t>(at - s.types.begin());
    std::vector<std::string> known;
    for (const TypeSource& t : s.types) known.push_back(t.name);
    const std::string nearest = nearest_name(name, known);
    refuse_at(path, fmt::format("there is no type called '{}'", name),
              nearest.empty() ? "add it to types" : fmt::format("did you mean '{}'?", nearest));
  }

  static void avoid(const Json& j, std::size_t index, Scene& s) {
    if (!j.contains("avoid")) return;
    const std::string path = fmt::format("types[{}].avoid", index);
    TypeSource& t = s.types[index];
    if (!(t.spacing > 0))
      refuse_at(path, fmt::format("'{}' has no spacing", t.name), "say by spacing how far it keeps off them");
    for (std::size_t k = 0; k < j["avoid"].size(); ++k) {
      const std::string place = fmt::format("{}[{}]", path, k);
      const std::size_t other = type_called(j["avoid"][k].get<std::string>(), place, s);
      if (s.types[other].spacing > 0)
        refuse_at(place, fmt::format("'{}' has spacing, and is kept apart by that", s.types[other].name),
                  "leave it out of avoid");
      t.avoid.push_back(other);
    }
  }

  MixSource mix(const Json& j, std::size_t index, const Scene& s) const {
    MixSource m;
    m.count = j["count"].get<std::uint64_t>();
    m.density = map(j, "density");
    for (std::size_t i = 0; i < j["parts"].size(); ++i) {
      const Json& part = j["parts"][i];
      const auto name = part["type"].get<std::string>();
      const std::string path = fmt::format("mixes[{}].parts[{}].type", index, i);
      const std::size_t at = type_called(name, path, s);
      if (s.types[at].count > 0 || s.types[at].density)
        refuse_at(path, fmt::format("'{}' has a count or a density of its own", name),
                  "leave both to the mix");
      m.parts.push_back({at, map(part["share"])});
      for (std::size_t k = 0; k + 1 < m.parts.size(); ++k)
        if (m.parts[k].type == m.parts.back().type)
          refuse_at(path, fmt::format("'{}' is in this mix twice", name), "name it once");
    }
    return m;
  }

  const Json& root_;
  fs::path folder_;
  std::map<std::string, std::uint32_t> names_;  // of the materials
};

}  // namespace

Result<Scene> read_scene(const Json& document, const fs::path& file) {
  try {
    Scene scene = Reader(document, file).read();
    for (std::size_t m = 0; m < scene.mixes.size(); ++m)
      for (const MixSource::Part& part : scene.mixes[m].parts)
        for (std::size_t k = 0; k < m; ++k)
          for (const MixSource::Part& other : scene.mixes[k].parts)
            if (part.type == other.type)
              refuse_at(fmt::format("mixes[{}]", m),
                        fmt::format("'{}' is in mixes[{}] as well", scene.types[part.type].name, k),
                        "let each type be in one mix");
    return scene;
  } catch (const Refusal& r) {
    return refuse(file.string(), r.what, r.remedy);
  }
}

}  // namespace copse::ecogen
