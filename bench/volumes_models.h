// The models that bounding volumes are measured on.
#pragma once

#include "lib/formats/vec.h"

#include <filesystem>
#include <string>
#include <vector>

namespace copse {

struct BenchModel {
  std::string name;    // "meshes/bones.off"
  std::string source;  // "CGAL", "trimesh", "real trees", ...
  std::filesystem::path file;
  // Least volumes known (volumes_best.txt), of the oriented box, sphere, capsule and lozenge; 0: none is.
  double box = 0, sphere = 0, capsule = 0, lozenge = 0;
};

// Models by source: CGAL's data (Debian's libcgal-demo, unpacked into a folder of its own while this lives),
// trees grown by treegrow, the trees of ../shared/trees where that is there, and every mesh in the folders
// that the environment's COPSE_MODELS names ("a:b"), among them the models of volumes_best.txt that no
// package has.
class BenchModels {
 public:
  BenchModels();
  ~BenchModels();
  BenchModels(const BenchModels&) = delete;
  BenchModels& operator=(const BenchModels&) = delete;

  const std::vector<BenchModel>& found() const { return found_; }
  // What was looked for and is not there, a line each, with what to do.
  const std::vector<std::string>& missing() const { return missing_; }

 private:
  void add_folder(const std::filesystem::path& folder, const std::string& source);
  void add_cgal();
  void add_grown();
  void add_best();

  std::filesystem::path scratch_;
  std::vector<BenchModel> found_;
  std::vector<std::string> missing_;
};

}  // namespace copse
