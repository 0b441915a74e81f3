// The answers of treedump.
#pragma once

#include "lib/formats/export/export.h"
#include "lib/formats/report.h"
#include "tools/treedump/dump.h"
#include "tools/treedump/options.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace copse {

// For a person; lines of at most 100 columns, long names apart.
std::string summary_text(const Dump& dump);

// For a program: schema copse.dump/1, see docs/tools.md.
std::string json_text(const Dump& dump, bool arrays);

// The sections with their sizes and shares, for a person.
std::string sections_text(std::span<const SectionState> sections, std::uint64_t file_size);

// The sections as a table, for the report page.
Table sections_table(const Dump& dump);

// {"radii":[...],"leaf_groups":[...]} of a sound .stree. Refused when the file has no hierarchy.
Result<std::string> hierarchy_json(const TreeFile& file, const std::string& name);

// Everything that is wrong with a file, one line each; empty when it is sound.
Result<std::vector<std::string>> verify_file(const std::filesystem::path& path);

// The geometry at the wanted level, with texture paths as seen from the folder of the output.
Result<std::vector<ExportedFile>> export_tree(const TreeFile& file, const DumpOptions& options);

// What differs. Precondition: both trees are sound.
struct Difference {
  std::vector<std::string> lines;  // what counts
  std::vector<std::string> notes;  // provenance and storage
};
Result<Difference> diff_files(const TreeFile& a, const TreeFile& b, double tolerance);
// The same of two files that are no trees (.eco): section by section.
Result<Difference> diff_containers(const Container& a, const Container& b);
// One line for every section, but those in `except`, that only one file has or whose decoded bytes differ.
Result<std::vector<std::string>> diff_sections(const Container& a, const Container& b,
                                               std::span<const std::string_view> except);

}  // namespace copse
