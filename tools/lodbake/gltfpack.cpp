#include "tools/lodbake/gltfpack.h"

#include "lib/formats/export/export.h"
#include "lib/formats/import/import.h"

#include <array>
#include <charconv>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace copse::lodbake {
namespace {

namespace fs = std::filesystem;

bool runs(std::vector<std::string> command) {
  std::vector<char*> arguments;
  for (std::string& word : command) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t silence;
  posix_spawn_file_actions_init(&silence);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&silence, stream, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int failed = posix_spawnp(&child, arguments[0], &silence, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&silence);
  int status = 1;
  return failed == 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

// The number by which a material was named on the way out.
std::uint32_t number_of(const Mesh& mesh, std::uint32_t material) {
  if (material >= mesh.materials.size()) return k_none;
  const std::string& name = mesh.materials[material].name;
  std::uint32_t number = k_none;
  std::from_chars(name.data(), name.data() + name.size(), number);
  return number;
}

DrawnMesh drawn(const Mesh& mesh, const Double3& origin) {
  DrawnMesh out;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto first = static_cast<std::uint32_t>(out.positions.size());
    for (std::size_t c = 0; c < 3; ++c) {
      const auto corner = [&](const std::vector<Triangle>& list) {
        return list.empty() ? k_none : list[t][c];
      };
      const std::uint32_t n = corner(mesh.normal_triangles), u = corner(mesh.texcoord_triangles);
      out.positions.push_back(mesh.positions[mesh.triangles[t][c]] - origin);
      out.normals.push_back(n == k_none ? Float3{} : mesh.normals[n]);
      out.texcoords.push_back(u == k_none ? Float2{} : mesh.texcoords[u]);
    }
    out.triangles.push_back({first, first + 1, first + 2});
    out.material.push_back(mesh.part_of.empty() ? k_none
                                                : number_of(mesh, mesh.parts[mesh.part_of[t]].material));
  }
  return out;
}

}  // namespace

Gltfpack::Folder::~Folder() {
  std::error_code ignored;
  if (!path.empty()) fs::remove_all(path, ignored);
}

std::optional<Gltfpack> Gltfpack::find(const Tree& tree) {
  if (!runs({"gltfpack", "-v"}) && !runs({"gltfpack", "-h"})) return std::nullopt;
  std::error_code error;
  std::string name = (fs::temp_directory_path(error) / "copse-sweep-XXXXXX").string();
  if (error || mkdtemp(name.data()) == nullptr) return std::nullopt;
  Gltfpack out;
  out.folder_ = std::make_unique<Folder>(name);
  out.origin_ = tree.header.origin;
  Mesh mesh = to_mesh(tree);
  mesh.textures.clear();  // they change nothing, and need not be found
  for (std::size_t m = 0; m < mesh.materials.size(); ++m) {
    mesh.materials[m].name = fmt::format("{}", m);
    mesh.materials[m].texture = k_none;
  }
  const auto files = export_mesh(mesh, ExportFormat::glb, "in.glb");
  if (!files) return std::nullopt;
  std::ofstream(out.folder_->path / "in.glb", std::ios::binary) << files->front().bytes;
  return out;
}

std::optional<DrawnMesh> Gltfpack::level(double share, bool aggressive) const {
  const fs::path in = folder_->path / "in.glb", result = folder_->path / "out.glb";
  std::vector<std::string> command{"gltfpack", "-i",  in.string(), "-o",  result.string(),         "-noq",
                                   "-kv",      "-km", "-kn",       "-si", fmt::format("{}", share)};
  if (aggressive)
    command.push_back("-sa");
  else
    command.insert(command.end(), {"-se", "1"});
  if (!runs(std::move(command))) return std::nullopt;
  const auto back = import_mesh(result);
  if (!back) return std::nullopt;
  return drawn(back->mesh, origin_);
}

}  // namespace copse::lodbake
