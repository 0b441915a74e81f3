// An OpenGL context without a window, through EGL: on a GPU where there is one that may be used, otherwise on
// Mesa's software rasteriser. Needs no display.
#pragma once

#include "lib/formats/result.h"

#include <memory>
#include <string>

namespace copse::treeplay {

class GlContext {
 public:
  virtual ~GlContext() = default;
  std::string renderer() const;  // "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5 (Core Profile) Mesa 22.3.6"
};

// The context is current when it is returned. `threads` is how many a software rasteriser may use.
Result<std::unique_ptr<GlContext>> make_headless(int threads);

}  // namespace copse::treeplay
