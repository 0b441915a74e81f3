#include "tools/treeplay/headless.h"

#include <array>
#include <cstdlib>
#include <vector>

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

namespace copse::treeplay {

std::string GlContext::renderer() const {
  const auto text = [](GLenum name) {
    const auto* s = reinterpret_cast<const char*>(glGetString(name));
    return std::string(s ? s : "unknown");
  };
  return text(GL_RENDERER) + ", OpenGL " + text(GL_VERSION);
}

namespace {

constexpr const char* k_install =
    "install libegl1 and libgl1-mesa-dri (Mesa), or run it where a GPU driver is";

// libepoxy ends the process when a library is missing, so look before it does.
bool has_library(const char* name) {
  void* library = dlopen(name, RTLD_LAZY | RTLD_LOCAL);
  if (library) dlclose(library);
  return library != nullptr;
}

class HeadlessContext final : public GlContext {
 public:
  HeadlessContext(EGLDisplay display, EGLContext context) : display_(display), context_(context) {}
  ~HeadlessContext() override {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
    eglTerminate(display_);
  }

 private:
  EGLDisplay display_;
  EGLContext context_;
};

// Every way to a display that needs no window system, the most usual first.
std::vector<EGLDisplay> displays() {
  std::vector<EGLDisplay> found;
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
    found.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr));
  }
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") &&
      epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration")) {
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    if (eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count)) {
      for (EGLint i = 0; i < count; ++i) {
        const EGLDeviceEXT device = devices[static_cast<std::size_t>(i)];
        found.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
      }
    }
  }
  return found;
}

// Makes a context of GL 4.5, or of 3.3, without a surface; says in `why` what is in the way.
std::unique_ptr<GlContext> try_display(EGLDisplay display, std::string& why) {
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) {
    why = "EGL cannot be initialised";
    return nullptr;
  }
  why = "the driver offers no OpenGL 3.3 core context without a surface";
  if (epoxy_has_egl_extension(display, "EGL_KHR_surfaceless_context") && eglBindAPI(EGL_OPENGL_API)) {
    for (const auto& [major, minor] : {std::pair{4, 5}, std::pair{3, 3}}) {
      const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                               major,
                               EGL_CONTEXT_MINOR_VERSION,
                               minor,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                               EGL_NONE};
      const EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
      if (context == EGL_NO_CONTEXT) continue;
      if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
        return std::make_unique<HeadlessContext>(display, context);
      }
      eglDestroyContext(display, context);
    }
  }
  eglTerminate(display);
  return nullptr;
}

}  // namespace

Result<std::unique_ptr<GlContext>> make_headless(int threads) {
  if (!has_library("libEGL.so.1")) return fail(Fault::io, "libEGL.so.1", "is not installed", k_install);
  if (!has_library("libOpenGL.so.0") && !has_library("libGL.so.1")) {
    return fail(Fault::io, "libGL.so.1", "is not installed", k_install);
  }
  // Mesa's software rasteriser reads this once; a value that the user has set wins.
  setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 0);
  std::string why = "EGL offers no display that works without a window system";
  for (const EGLDisplay display : displays()) {
    if (auto context = try_display(display, why)) return context;
  }
  return fail(Fault::io, "", "no OpenGL without a display: " + why, k_install);
}

}  // namespace copse::treeplay
