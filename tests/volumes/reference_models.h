// The data meshes of CGAL that volumes were measured on, from a tarball in Debian's libcgal-demo, and the
// least volumes that 80 to 100 starts of a random search had found around them.
#pragma once

#include "lib/formats/vec.h"

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace copse {

struct ReferenceModel {
  const char* name;
  double capsule, lozenge;  // best known
};

inline constexpr std::array k_reference_models{
    ReferenceModel{"ChineseDragon-10kv", 890317.5, 746645.5},
    ReferenceModel{"anchor_dense", 0.6450281, 0.6033466},
    ReferenceModel{"armadillo", 2131055, 1924021},
    ReferenceModel{"blade", 10645.34, 828.8873},
    ReferenceModel{"bones", 146.6888, 126.0664},
    ReferenceModel{"bunny00", 0.7041247, 0.6133681},
    ReferenceModel{"camel", 0.6193833, 0.2770674},
    ReferenceModel{"couplingdown", 0.6081212, 0.4648457},
    ReferenceModel{"cow", 0.3095803, 0.1834665},
    ReferenceModel{"cylinder_locally_refined", 0.4787874, 0.3367959},
    ReferenceModel{"dino", 29.89834, 24.5434},
    ReferenceModel{"elephant", 0.4276596, 0.3663161},
    ReferenceModel{"fandisk", 0.6457107, 0.5532006},
    ReferenceModel{"femur", 0.1263533, 0.08967318},
    ReferenceModel{"homer", 0.236458, 0.1861893},
    ReferenceModel{"knot1", 0.6035049, 0.4083951},
    ReferenceModel{"lion-head", 0.6136696, 0.5033078},
    ReferenceModel{"mech-holes-shark", 1.350869, 1.27939},
    ReferenceModel{"mushroom", 1.010438, 0.589801},
    ReferenceModel{"refined_elephant", 0.4223162, 0.3617763},
    ReferenceModel{"rotor_small", 0.1444737, 0.1197906},
    ReferenceModel{"triceratops", 920.6638, 816.9274},
    ReferenceModel{"turbine", 0.5245002, 0.2554698}};

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
