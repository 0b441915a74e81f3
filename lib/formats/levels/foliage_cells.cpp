#include "lib/formats/levels/foliage_cells.h"

#include "lib/formats/hash.h"

#include <cmath>
#include <cstring>
#include <vector>

#include <fmt/format.h>

namespace copse {
namespace {

constexpr std::uint32_t k_version = 1;

template <class T>
Array<std::uint8_t> bytes_of(std::span<const T> elements) {
  std::vector<std::uint8_t> out(elements.size_bytes());
  if (!out.empty()) std::memcpy(out.data(), elements.data(), out.size());
  return out;
}

template <class T>
Result<void> load(const TreeFile& file, std::string_view name, std::vector<T>& out) {
  auto bytes = file.section(name);
  if (!bytes) return std::unexpected(bytes.error());
  if (bytes->size() % sizeof(T) != 0)
    return refuse("",
                  fmt::format("section {} has {} bytes, no whole number of entries of {}", name,
                              bytes->size(), sizeof(T)),
                  "restore the file, or bake its foliage cells again");
  out.resize(bytes->size() / sizeof(T));
  if (!out.empty()) std::memcpy(out.data(), bytes->data(), bytes->size());
  return {};
}

bool share(float x) {
  return x >= 0 && x <= 1;
}

std::string check_parameters(const FoliageParameters& p) {
  if (!(p.near >= 0) || !(p.far >= p.near) || !std::isfinite(p.far))
    return "FPAR: 0 <= near <= far does not hold";
  if (!share(p.least)) return "FPAR: the least fraction is not between 0 and 1";
  if (!(p.half_distance > 1) || !std::isfinite(p.half_distance)) return "FPAR: h is not above 1";
  if (!(p.largest_enlargement >= 1) || !std::isfinite(p.largest_enlargement))
    return "FPAR: the largest enlargement is below 1";
  if (std::uint32_t(p.distance) > 1 || std::uint32_t(p.compensation) > 1 || std::uint32_t(p.anchor) > 0 ||
      std::uint32_t(p.ramp) > 1)
    return "FPAR: a choice has no known value";
  return {};
}

std::string check_cells(const FoliageCells& f, std::uint64_t leaves) {
  std::uint64_t at = 0;
  for (std::size_t c = 0; c < f.cells.size(); ++c) {
    const FoliageCell& cell = f.cells[c];
    if (cell.first != at || cell.count == 0)
      return fmt::format("FCEL: cell {} begins at leaf {}, not at {}, or is empty", c, cell.first, at);
    at += cell.count;
    bool fine = is_finite(cell.box.centre) && is_finite(cell.box.half_extents);
    for (int a = 0; a < 3; ++a) fine = fine && is_finite(cell.box.axes[a]) && cell.box.half_extents[a] >= 0;
    if (!fine) return fmt::format("FCEL: the box of cell {} is not finite", c);
  }
  if (at != f.order.size() || at != leaves)
    return fmt::format("FCEL: cells hold {} leaves, the order {}, the tree {}", at, f.order.size(), leaves);
  std::vector<bool> seen(f.order.size(), false);
  for (std::size_t i = 0; i < f.order.size(); ++i) {
    if (f.order[i] >= seen.size() || seen[f.order[i]])
      return fmt::format("FORD: entry {} is leaf {}, again or beyond the last", i, f.order[i]);
    seen[f.order[i]] = true;
  }
  return {};
}

std::string check_views(const FoliageCells& f) {
  for (std::size_t v = 0; v < f.views.size(); ++v) {
    const Float3& d = f.views[v];
    if (!(std::abs(dot(to_double(d), to_double(d)) - 1) < 1e-5))
      return fmt::format("FVWS: view {} is no unit vector", v);
  }
  for (std::size_t t = 0; t < f.view_triangles.size(); ++t)
    for (const std::uint32_t v : f.view_triangles[t])
      if (v >= f.views.size())
        return fmt::format("FVTR: triangle {} names view {} of {}", t, v, f.views.size());
  if (f.views.size() > 0 && f.visibility.size() / f.views.size() != f.cells.size())
    return "FVIS: there is not one entry for every cell and view";
  if (f.visibility.size() != f.cells.size() * f.views.size())
    return "FVIS: there is not one entry for every cell and view";
  for (std::size_t i = 0; i < f.visibility.size(); ++i)
    if (f.visibility[i].visible > f.visibility[i].total)
      return fmt::format("FVIS: entry {} sees more pixels than there are", i);
  return {};
}

}  // namespace

std::uint64_t hash_leaves(const Tree& tree) {
  const auto positions = std::as_bytes(tree.leaves.vertices.span());
  const auto triangles = std::as_bytes(tree.leaves.triangles.span());
  const auto hash = [](std::span<const std::byte> b) {
    return xxh3(std::span(reinterpret_cast<const std::uint8_t*>(b.data()), b.size()));
  };
  return hash(positions) * 0x9e3779b97f4a7c15u ^ hash(triangles);
}

Result<void> put_foliage_cells(ContainerWriter& writer, const FoliageCells& f) {
  const auto put = [&](std::string_view name, std::uint32_t stride, Array<std::uint8_t> bytes) {
    return writer.put(name, k_version, stride, std::move(bytes), Encoding::zstd);
  };
  const std::span<const FoliageParameters> parameters(&f.parameters, 1);
  if (auto r = put("FCEL", sizeof(FoliageCell), bytes_of(f.cells.span())); !r) return r;
  if (auto r = put("FORD", 4, bytes_of(f.order.span())); !r) return r;
  if (auto r = put("FVWS", sizeof(Float3), bytes_of(f.views.span())); !r) return r;
  if (auto r = put("FVTR", 12, bytes_of(f.view_triangles.span())); !r) return r;
  if (auto r = put("FVIS", sizeof(CellVisibility), bytes_of(f.visibility.span())); !r) return r;
  return put("FPAR", sizeof(FoliageParameters), bytes_of(parameters));
}

Result<FoliageCells> read_foliage_cells(const TreeFile& file) {
  if (!file.has("FCEL")) return FoliageCells{};
  std::vector<FoliageCell> cells;
  std::vector<std::uint32_t> order;
  std::vector<Float3> views;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<CellVisibility> visibility;
  std::vector<FoliageParameters> parameters;
  if (auto r = load(file, "FCEL", cells); !r) return std::unexpected(r.error());
  if (auto r = load(file, "FORD", order); !r) return std::unexpected(r.error());
  if (auto r = load(file, "FVWS", views); !r) return std::unexpected(r.error());
  if (auto r = load(file, "FVTR", triangles); !r) return std::unexpected(r.error());
  if (auto r = load(file, "FVIS", visibility); !r) return std::unexpected(r.error());
  if (auto r = load(file, "FPAR", parameters); !r) return std::unexpected(r.error());
  const char* remedy = "restore the file, or bake its foliage cells again";
  if (parameters.size() != 1) return refuse("", "FPAR: there is not one set of parameters", remedy);
  FoliageCells out{std::move(cells),     std::move(order),      std::move(views),
                   std::move(triangles), std::move(visibility), parameters.front()};
  if (const std::string wrong = check_foliage_cells(out, file.counts().leaves); !wrong.empty())
    return refuse("", wrong, remedy);
  return out;
}

std::string check_foliage_cells(const FoliageCells& foliage, std::uint64_t leaves) {
  if (std::string wrong = check_parameters(foliage.parameters); !wrong.empty()) return wrong;
  if (std::string wrong = check_cells(foliage, leaves); !wrong.empty()) return wrong;
  return check_views(foliage);
}

}  // namespace copse
