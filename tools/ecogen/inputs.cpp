#include "tools/ecogen/inputs.h"

#include "lib/formats/container/mapped_file.h"
#include "lib/formats/hash.h"
#include "lib/formats/import/image.h"
#include "lib/formats/tree_file/tree_file.h"
#include "lib/formats/tree_file/tree_volumes.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace copse::ecogen {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view k_letters = "rgba";

// Which channel a name means; luminance is -1, none such -2.
int channel_of(const std::string& name, int channels) {
  const bool grey = channels < 3;  // with or without alpha
  if (name.empty() || name == "y") return grey ? 0 : -1;
  const std::size_t letter = name.size() == 1 ? k_letters.find(name[0]) : std::string::npos;
  int index = 0;
  if (letter == std::string::npos)
    index = std::stoi(name);
  else if (!grey || letter == 0)
    index = static_cast<int>(letter);
  else
    index = letter == 3 ? 1 : channels;  // no green or blue
  return index < channels ? index : -2;
}

std::string channels_text(int channels) {
  if (channels == 1) return "one channel, grey (y or r)";
  if (channels == 2) return "2 channels, grey (y or r) and alpha (a)";
  return fmt::format("{} channels", channels);
}

Result<std::unique_ptr<ValueMap>> values_of(const FloatImage& image, const MapSource& source) {
  const int channel = channel_of(source.channel, image.channels);
  if (channel == -2)
    return refuse(source.file.string(),
                  fmt::format("has {}, none is '{}'", channels_text(image.channels), source.channel),
                  "name one that it has");
  auto map = std::make_unique<ValueMap>();
  map->width = static_cast<std::uint32_t>(image.width);
  map->height = static_cast<std::uint32_t>(image.height);
  map->values.resize(std::size_t{map->width} * map->height);
  const auto n = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < map->values.size(); ++i) {
    const float* p = image.values.data() + i * n;
    const double v = channel >= 0 ? static_cast<double>(p[channel])
                                  : 0.2126 * static_cast<double>(p[0]) + 0.7152 * static_cast<double>(p[1]) +
                                        0.0722 * static_cast<double>(p[2]);
    const auto value = static_cast<float>(source.low + (source.high - source.low) * v);
    if (!std::isfinite(value))
      return refuse(source.file.string(),
                    fmt::format("pixel ({}, {}) is not finite", i % map->width, i / map->width),
                    "mend the image");
    map->values[i] = value;
  }
  return map;
}

// Those that bvfit proved to hold the whole tree. A tree far from its origin keeps to its box: moving them
// there would round them.
Result<void> take_volumes(const TreeFile& file, TreeType& type) {
  if (!file.has("VSET") || !(file.header().origin == Double3{})) return {};
  const auto all = load_volumes(file);
  if (!all) return std::unexpected(all.error());
  for (const VolumeSet& set : all->sets) {
    if (set.part != VolumePart::whole) continue;
    auto& volumes = set.motion == VolumeMotion::envelope ? type.envelopes : type.volumes;
    for (std::size_t v = set.first; v < set.first + set.count; ++v) {
      const VolumeRecord& r = all->volumes[v];
      if ((r.flags & VolumeRecord::certified) && r.kind != VolumeKind::kdop)
        volumes.push_back(all->volume(v));
    }
  }
  return {};
}

}  // namespace

void Inputs::take(const fs::path& file) {
  context_.read(file, true);
  if (std::find(files_.begin(), files_.end(), file) == files_.end()) files_.push_back(file);
}

Result<const ValueMap*> Inputs::map(const MapSource& source) {
  auto& known = maps_[source];
  if (known) return known.get();
  const auto image = read_float_image(source.file);
  if (!image) return std::unexpected(image.error());
  take(source.file);
  auto values = values_of(*image, source);
  if (!values) return std::unexpected(values.error());
  known = std::move(*values);
  return known.get();
}

Result<const ValueMap*> Inputs::map(const std::optional<MapSource>& source) {
  if (!source) return nullptr;
  return map(*source);
}

Result<const TintMap*> Inputs::tint(const fs::path& file) {
  if (file.empty()) return nullptr;
  auto& known = tints_[file];
  if (known) return known.get();
  const auto image = read_image(file);
  if (!image) return std::unexpected(image.error());
  take(file);
  known = std::make_unique<TintMap>();
  known->width = static_cast<std::uint32_t>(image->width);
  known->height = static_cast<std::uint32_t>(image->height);
  known->colours.resize(image->rgba.size() / 4);
  for (std::size_t i = 0; i < known->colours.size(); ++i)
    known->colours[i] = {image->rgba[4 * i], image->rgba[4 * i + 1], image->rgba[4 * i + 2]};
  return known.get();
}

Result<TreeType> read_type(const TypeSource& source, Context& context) {
  const auto file = TreeFile::open(source.tree);
  if (!file) return std::unexpected(file.error());
  const auto record = hash_file(source.tree);
  if (!record) return std::unexpected(record.error());
  context.read(source.tree, true);
  TreeType t;
  t.name = source.name;
  t.hash = std::stoull(record->hash.substr(record->hash.find(':') + 1), nullptr, 16);
  t.view_range = static_cast<float>(source.view_range);
  t.scale_min = round_down(source.scale.min);
  t.scale_max = round_up(source.scale.max);
  const TreeHeader& h = file->header();
  if (!h.bounds.empty())
    t.bounds = round_outward({h.origin + to_double(h.bounds.min), h.origin + to_double(h.bounds.max)});
  if (auto done = take_volumes(*file, t); !done) return std::unexpected(done.error());
  return t;
}

}  // namespace copse::ecogen
