#include "tools/treeprep/texture_stage.h"

#include "lib/analysis/measure/texture_statistics.h"
#include "lib/formats/import/image.h"

#include <fmt/format.h>

namespace copse::treeprep {
namespace {

// Reads the textures one after another, as the statistics ask for them.
class Textures {
 public:
  Textures(const Input& input, const Options& options, Context& context)
      : input_(input), folder_(options.output.parent_path()), context_(context) {}

  std::optional<TextureImage> operator()(std::uint32_t index) {
    const Texture& texture = input_.mesh.textures[index];
    auto image = texture.uri.empty()
                     ? read_image(texture.bytes, fmt::format("{}: embedded texture {}", input_.name, index))
                     : read_image(folder_ / texture.uri);
    if (!image) {
      failures_.push_back(std::move(image.error()));
      return std::nullopt;
    }
    if (!texture.uri.empty()) context_.read(folder_ / texture.uri, false);
    image_ = std::move(*image);
    return TextureImage{image_.width, image_.height, image_.rgba};
  }
  const std::vector<Error>& failures() const { return failures_; }

 private:
  const Input& input_;
  std::filesystem::path folder_;
  Context& context_;
  Image image_;
  std::vector<Error> failures_;
};

}  // namespace

Result<void> texture_stage(Input& input, const Options& options, Context& context) {
  if (input.mesh.textures.empty()) return {};
  Stage stage = context.stage("textures");
  stage.items(input.mesh.textures.size(), "textures");
  Textures textures(input, options, context);
  const auto statistics = texture_statistics(input.mesh, std::ref(textures));
  for (const Error& e : textures.failures()) {
    if (options.strict) return std::unexpected(e);
    context.warn(fmt::format("{}: {}; the texture counts as white and opaque", e.file, e.what));
  }
  copse::apply(statistics, input.mesh.materials);  // qualified: std::apply would be a candidate
  return {};
}

}  // namespace copse::treeprep
