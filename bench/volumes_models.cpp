#include "bench/volumes_models.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

namespace copse {
namespace {

namespace fs = std::filesystem;

constexpr const char* k_archive = "/usr/share/doc/libcgal-dev/data.tar.gz";

bool is_mesh(const fs::path& path) {
  fs::path p = path;
  if (p.extension() == ".gz") p = p.stem();
  std::string e = p.extension().string();
  std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return e == ".obj" || e == ".off" || e == ".ply" || e == ".stl";
}

}  // namespace

BenchModels::BenchModels() {
  scratch_ = fs::temp_directory_path() / "copse-bench-volumes-XXXXXX";
  std::string name = scratch_.string();
  if (mkdtemp(name.data()) == nullptr) {
    missing_.push_back(
        "all models that need a folder to be unpacked into: there is none in the temporary folder");
    return;
  }
  scratch_ = name;
  add_cgal();
  const char* folders = std::getenv("COPSE_MODELS");
  std::istringstream list(folders != nullptr ? folders : "");
  for (std::string folder; std::getline(list, folder, ':');) {
    if (fs::is_directory(folder)) {
      add_folder(folder, fs::path(folder).filename().string());
    } else {
      missing_.push_back(folder + ": COPSE_MODELS names it, but there is no such folder");
    }
  }
  const fs::path trees = fs::path(COPSE_SOURCE_DIR) / ".." / "shared" / "trees";
  if (fs::is_directory(trees)) add_folder(trees, "real trees");
  add_grown();
  add_best();
}

BenchModels::~BenchModels() {
  std::error_code ignored;
  fs::remove_all(scratch_, ignored);
}

void BenchModels::add_folder(const fs::path& folder, const std::string& source) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && is_mesh(entry.path())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files)
    found_.push_back({source + "/" + file.filename().string(), source, file});
}

// Of the archive only what volumes_best.txt names: it has many meshes twice.
void BenchModels::add_cgal() {
  if (!fs::exists(k_archive) ||
      std::system(fmt::format("tar -xzf {} -C '{}'", k_archive, scratch_.string()).c_str()) != 0) {
    missing_.push_back("CGAL's meshes: apt-get install libcgal-demo");
  }
}

void BenchModels::add_grown() {
  for (const char* species :
       {"oak", "birch", "cherry", "willow", "spruce", "pine", "palm", "bush", "dead", "grass"}) {
    const fs::path file = scratch_ / (std::string(species) + ".ply");
    const std::string call =
        fmt::format("treegrow {} --no-textures -q -o '{}' 2>/dev/null", species, file.string());
    if (std::system(call.c_str()) == 0) {
      found_.push_back({std::string("treegrow/") + species, "treegrow", file});
    } else {
      missing_.push_back(
          fmt::format("treegrow {}: build the tools, and call this by ./run bench volumes", species));
    }
  }
}

// Volumes of models that are there, and CGAL's models themselves.
void BenchModels::add_best() {
  std::ifstream list(COPSE_SOURCE_DIR "/bench/volumes_best.txt");
  std::vector<BenchModel> cgal;
  std::size_t absent = 0;
  for (std::string line; std::getline(list, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream row(line);
    BenchModel m;
    row >> m.name >> m.box >> m.sphere >> m.capsule >> m.lozenge;
    const auto same =
        std::find_if(found_.begin(), found_.end(), [&](const BenchModel& f) { return f.name == m.name; });
    m.file = scratch_ / "data" / m.name;
    m.source = "CGAL";
    if (same != found_.end()) {
      same->box = m.box, same->sphere = m.sphere, same->capsule = m.capsule, same->lozenge = m.lozenge;
    } else if (fs::exists(m.file)) {
      cgal.push_back(m);
    } else {
      ++absent;
    }
  }
  found_.insert(found_.begin(), cgal.begin(), cgal.end());
  if (absent > 0) {
    missing_.push_back(fmt::format(
        "{} models of volumes_best.txt: its head says where they are; name the folders in COPSE_MODELS",
        absent));
  }
}

}  // namespace copse
