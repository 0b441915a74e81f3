#include "lib/analysis/volumes/check_certificates.h"
#include "lib/formats/ecosystem/ecosystem_file.h"
#include "lib/formats/ecosystem/type_hash.h"
#include "tools/treedump/levels_view.h"
#include "tools/treedump/views.h"

#include <algorithm>

namespace copse {

Result<std::vector<std::string>> verify_file(const std::filesystem::path& path) {
  auto container = Container::open(path);
  if (!container && container.error().fault != Fault::refused) return std::unexpected(container.error());
  if (!container) return std::vector<std::string>{container.error().what};
  if (container->kind() == FileKind::eco) {
    const auto eco = EcosystemFile::open(path);
    if (!eco) return std::vector<std::string>{eco.error().what};
    auto failures = eco->verify();
    const auto sound = failures.empty() ? eco->load(Instances::on_demand) : Result<Ecosystem>(Ecosystem{});
    if (sound && failures.empty()) failures = changed_trees(*sound, path.parent_path());
    return failures;
  }
  const auto file = TreeFile::open(path);
  if (file) {
    auto failures = file->verify();
    if (!failures.empty()) return failures;
    failures = verify_levels(*file);
    const auto volumes = load_volumes(*file);
    const auto tree = file->load();
    const auto cells = read_foliage_cells(*file);
    if (!volumes || volumes->empty() || !tree || !cells) return failures;
    for (std::string& line : check_certificates(*tree, *volumes, *cells)) failures.push_back(std::move(line));
    return failures;
  }
  // Header or table do not fit together; the checksums can be checked all the same.
  std::vector<std::string> failures{file.error().what};
  for (const SectionInfo& section : container->sections()) {
    const auto sound = container->verify(section);
    if (!sound && sound.error().what != failures.front()) failures.push_back(sound.error().what);
  }
  return failures;
}

}  // namespace copse
