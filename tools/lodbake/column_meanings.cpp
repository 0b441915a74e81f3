#include "tools/lodbake/column_meanings.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace copse::lodbake {
namespace {

using Meaning = std::pair<std::string_view, std::string_view>;

constexpr std::array k_meanings{
    Meaning{"Share", "triangles of the level / triangles of full detail"},
    Meaning{"Trunk", "triangles of the trunk"},
    Meaning{"Leaves", "triangles of the leaves"},
    Meaning{"Error (m)", "estimate of how far what is drawn lies from what it stands for"},
    Meaning{"From (m)", "distance from the camera at which the level takes over from the finer one"},
    Meaning{"Floating leaves",
            "leaves that are farther from the trunk as drawn than they were, by a hundredth of the height: "
            "must be 0"},
    Meaning{"Lumps",
            "surfaces of many triangles among the leaves, which lose edges before leaves are merged"},
    Meaning{"Edges until (triangles)", "of the leaves, when that ends and what is left is merged as leaves"},
    Meaning{"Area", "area of all triangles / that of full detail"},
    Meaning{"Leaf area", "area of the leaves' triangles / that of full detail"},
    Meaning{"Coverage", "covered pixels of all views / those of full detail; 1 is right"},
    Meaning{"Coverage, least",
            "the same of the view in which it is least: a trunk that is gone from there shows"},
    Meaning{"Coverage, most", "the same of the view in which it is most"},
    Meaning{"IoU, least", "silhouette IoU of the worst view"},
    Meaning{"Silhouette IoU", "covered in both / covered in either, mean over the views; 1 is right"},
    Meaning{"RMSE", "root mean square error of the pictures, sRGB from 0 to 1; 0 is right"},
    Meaning{"SSIM", "structural similarity of the pictures; 1 is right"},
    Meaning{"Hull growth", "how far the level reaches out of full detail's convex hull / its largest width"},
    Meaning{"Pixels", "width of the pictures that are compared"},
    Meaning{"Level to source (m)", "mean distance from points of the level to full detail's surface"},
    Meaning{"Source to level (m)", "mean distance from points of full detail to the level's surface"},
    Meaning{"Level to source, largest (m)", "the largest of these distances"},
    Meaning{"Source to level, largest (m)",
            "the largest of these distances; the larger one of both is what --max-error limits"},
    Meaning{"Lost branch length", "length of the segments whose tubes are gone / that of all"},
    Meaning{"Bytes", "of both spectra, if this level were the only one beside full detail"},
    Meaning{"Extraction (us)", "time to write the index lists of the level, microseconds, median of 21"},
    Meaning{
        "Estimate",
        "directions as the thesis prints them (cosine, 1 / 1.8), spread evenly, or by their second moments"},
    Meaning{"Of the picture", "share of a square picture that the tree's bounding sphere takes up"},
    Meaning{"Leaf area, mean", "|estimate / truth - 1| of the projected area, mean over the views"},
};

}  // namespace

Table column_meanings(const std::vector<Table>& tables) {
  Table out{.name = "columns", .columns = {"Column", "Meaning"}, .rows = {}};
  for (const auto& [name, meaning] : k_meanings) {
    const bool shown = std::any_of(tables.begin(), tables.end(), [&, n = name](const Table& t) {
      return std::find(t.columns.begin(), t.columns.end(), n) != t.columns.end();
    });
    if (shown) out.rows.push_back({std::string(name), std::string(meaning)});
  }
  return out;
}

}  // namespace copse::lodbake
