// The data meshes of CGAL that volumes were measured on, from a tarball in Debian's libcgal-demo, and the
// least volumes that 80 to 100 starts of a random search had found around them.
#pragma once

#include "lib/formats/vec.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace copse {

struct ReferenceModel {
  std::string name;                                      // "elephant"
  double box = 0, sphere = 0, capsule = 0, lozenge = 0;  // best known
};

// Those of bench/volumes_best.txt that are OFF meshes.
inline const std::vector<ReferenceModel>& reference_models() {
  static const std::vector<ReferenceModel> k_models = [] {
    const std::string folder = "meshes/", end = ".off";
    std::vector<ReferenceModel> models;
    std::ifstream list(COPSE_SOURCE_DIR "/bench/volumes_best.txt");
    for (std::string line; std::getline(list, line);) {
      std::istringstream row(line);
      ReferenceModel m;
      if (!(row >> m.name >> m.box >> m.sphere >> m.capsule >> m.lozenge)) continue;
      if (!m.name.starts_with(folder) || !m.name.ends_with(end)) continue;
      m.name = m.name.substr(folder.size(), m.name.size() - folder.size() - end.size());
      models.push_back(m);
    }
    return models;
  }();
  return k_models;
}

// Where the meshes lie, unpacked once a process into a folder that is removed at its end; empty without the
// package.
inline const std::filesystem::path& reference_folder() {
  struct Folder {
    std::filesystem::path path;
    Folder() {
      const char* tarball = "/usr/share/doc/libcgal-dev/data.tar.gz";
      if (!std::filesystem::exists(tarball)) return;
      std::string name = (std::filesystem::temp_directory_path() / "copse-reference-XXXXXX").string();
      if (mkdtemp(name.data()) == nullptr) return;
      path = name;
      const std::string command = std::string("tar xzf ") + tarball + " -C '" + name + "' data/meshes";
      if (std::system(command.c_str()) != 0) remove();
    }
    ~Folder() { remove(); }
    void remove() {
      std::error_code ignored;
      if (!path.empty()) std::filesystem::remove_all(path, ignored);
      path.clear();
    }
  };
  static const Folder k_folder;
  return k_folder.path;
}

// The vertices; none when the package has no such model.
inline std::vector<Double3> reference_points(const std::string& name) {
  std::ifstream file(reference_folder() / "data/meshes" / (name + ".off"));
  std::stringstream text;  // without comments
  for (std::string line; std::getline(file, line);) text << line.substr(0, line.find('#')) << '\n';
  std::string magic;
  std::size_t vertices = 0, faces = 0, edges = 0;
  text >> magic >> vertices >> faces >> edges;
  std::vector<Double3> points;
  for (Double3 p; points.size() < vertices && text >> p.x >> p.y >> p.z;) {
    points.push_back(p);
    text.ignore(std::numeric_limits<std::streamsize>::max(), '\n');  // colours
  }
  return points;
}

}  // namespace copse
