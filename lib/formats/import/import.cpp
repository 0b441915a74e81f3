#include "lib/formats/import/import.h"

#include "lib/formats/import/companions.h"
#include "lib/formats/import/detect.h"
#include "lib/formats/import/gltf/gltf.h"
#include "lib/formats/import/mesh_builder.h"
#include "lib/formats/import/obj.h"
#include "lib/formats/import/off.h"
#include "lib/formats/import/ply.h"
#include "lib/formats/import/source.h"
#include "lib/formats/import/stl.h"

#include <new>
#include <string_view>
#include <utility>

namespace copse {
namespace {

std::string_view as_text(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

bool read_format(MeshFormat format, std::span<const std::uint8_t> bytes, const Companions& companions,
                 const ImportOptions& options, MeshBuilder& builder) {
  switch (format) {
    case MeshFormat::obj:
      return read_obj(as_text(bytes), companions, builder);
    case MeshFormat::ply:
      return read_ply(as_text(bytes), builder);
    case MeshFormat::off:
      return read_off(as_text(bytes), builder);
    case MeshFormat::stl:
      return read_stl(bytes, builder);
    case MeshFormat::gltf:
    case MeshFormat::glb:
      return read_gltf(bytes, companions, options.instance_limit, builder);
    case MeshFormat::unknown:
      break;
  }
  return builder.refuse("is of no mesh format that is read here",
                        "give OBJ, PLY, OFF, STL, glTF or GLB, gzipped or not");
}

Result<Import> import_bytes(std::span<const std::uint8_t> stored, MeshFormat format, const std::string& name,
                            const Companions& companions, const ImportOptions& options) {
  Bytes inflated;
  std::span<const std::uint8_t> bytes = stored;
  if (is_gzip(stored)) {
    Result<Bytes> result = inflate_gzip(stored, name);
    if (!result) return std::unexpected(result.error());
    inflated = std::move(*result);
    bytes = inflated;
  }
  if (bytes.empty()) return refuse(name, "is empty", "export the mesh again");
  MeshBuilder builder(name, bytes.size(), options.strict);
  if (format == MeshFormat::unknown) format = detect_format(bytes, name);
  if (!read_format(format, bytes, companions, options, builder) && !builder.refused())
    return fail(Fault::bug, name, "was refused without a reason", "report this with the file");
  Result<Import> import = builder.finish(format);
  if (import) import->bytes = stored.size();
  return import;
}

// A library's exception, or running out of memory, is an answer like any other.
template <class Function>
Result<Import> guarded(const std::string& name, Function&& function) {
  try {
    return function();
  } catch (const std::bad_alloc&) {
    return refuse(name, "does not fit into memory", "use a machine with more memory, or a smaller mesh");
  } catch (const std::exception& e) {
    return fail(Fault::bug, name, std::string("cannot be read: ") + e.what(), "report this with the file");
  }
}

}  // namespace

Result<Import> import_mesh(const std::filesystem::path& path, const ImportOptions& options) {
  const std::string name = path.string();
  return guarded(name, [&]() -> Result<Import> {
    const Result<Bytes> bytes = open_bytes(path);
    if (!bytes) return std::unexpected(bytes.error());
    Result<Import> import = import_bytes(*bytes, MeshFormat::unknown, name, {path.parent_path()}, options);
    if (import) import->files.insert(import->files.begin(), path);
    return import;
  });
}

Result<Import> import_mesh(std::span<const std::uint8_t> bytes, MeshFormat format, const std::string& name,
                           const ImportOptions& options) {
  return guarded(name, [&] { return import_bytes(bytes, format, name, {}, options); });
}

}  // namespace copse
