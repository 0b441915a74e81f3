#include "tools/treeplay/path_file.h"

#include <array>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace copse::treeplay {

namespace {

using Json = nlohmann::json;

constexpr double k_radians = std::numbers::pi / 180;
constexpr const char* k_form =
    R"(write {"schema":"copse.path/1","keys":[{"time":0,"eye":[x,y,z],"target":[x,y,z]}, ...]})";

// What is wrong with a piece of the file; the caller adds its name.
struct Problem {
  std::string what;
};

template <class... Names>
void only(const Json& object, const std::string& where, Names... names) {
  if (!object.is_object()) throw Problem{where + " is not an object"};
  for (const auto& [name, value] : object.items()) {
    if (((name != names) && ...)) throw Problem{where + " has the unknown member \"" + name + "\""};
  }
}

double number(const Json& value, const std::string& where) {
  if (!value.is_number()) throw Problem{where + " is not a number"};
  return value.get<double>();
}

Double3 vector(const Json& object, const char* name, const std::string& where) {
  const std::string what = where + "." + name;
  if (!object.contains(name)) throw Problem{what + " is missing"};
  const Json& value = object.at(name);
  if (!value.is_array() || value.size() != 3) throw Problem{what + " is not an array of three numbers"};
  return {number(value[0], what), number(value[1], what), number(value[2], what)};
}

PathKey read_key(const Json& object, const std::string& where, const Camera& defaults) {
  only(object, where, "time", "eye", "target", "up", "fov");
  PathKey key;
  key.camera = defaults;
  if (!object.contains("time")) throw Problem{where + ".time is missing"};
  key.time = number(object.at("time"), where + ".time");
  key.camera.eye = vector(object, "eye", where);
  key.camera.target = vector(object, "target", where);
  if (object.contains("up")) key.camera.up = vector(object, "up", where);
  if (object.contains("fov")) key.camera.fov = k_radians * number(object.at("fov"), where + ".fov");
  return key;
}

std::vector<PathKey> read_keys(const Json& file, double fov) {
  only(file, "the file", "schema", "keys", "up", "fov");
  if (!file.contains("schema") || file.at("schema") != "copse.path/1") {
    throw Problem{"its schema is not \"copse.path/1\""};
  }
  Camera defaults;
  defaults.fov = file.contains("fov") ? k_radians * number(file.at("fov"), "fov") : fov;
  if (file.contains("up")) defaults.up = vector(file, "up", "the file");
  if (!file.contains("keys") || !file.at("keys").is_array()) throw Problem{"it has no array \"keys\""};
  std::vector<PathKey> keys;
  for (const Json& key : file.at("keys")) {
    keys.push_back(read_key(key, "keys[" + std::to_string(keys.size()) + "]", defaults));
  }
  return keys;
}

}  // namespace

Result<CameraPath> read_path(const std::filesystem::path& file, double fov) {
  std::ifstream stream(file, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  if (!stream.is_open() || stream.bad() || std::filesystem::is_directory(file)) {
    return fail(Fault::io, file.string(), "cannot be read", "check the name and the permissions");
  }
  try {
    auto path = CameraPath::through(read_keys(Json::parse(text), fov));
    if (!path) path.error().file = file.string();
    return path;
  } catch (const Problem& problem) {
    return refuse(file.string(), problem.what, k_form);
  } catch (const std::exception& e) {
    return refuse(file.string(), std::string("is not a camera path: ") + e.what(), k_form);
  }
}

}  // namespace copse::treeplay
