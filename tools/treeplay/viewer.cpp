#include "tools/treeplay/viewer.h"

#include "tools/treeplay/framing.h"
#include "tools/treeplay/headless.h"
#include "tools/treeplay/orbit_camera.h"
#include "tools/treeplay/overlay.h"

#include <chrono>
#include <memory>
#include <string>

// epoxy's GL declarations must come before GLFW's.
#include <epoxy/gl.h>
//
#include <GLFW/glfw3.h>
#include <fmt/format.h>

namespace copse::treeplay {

namespace {

using Clock = std::chrono::steady_clock;

double seconds(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

// GLFW for the life of the window, with the last thing that it complained about.
class Window final : public GlContext {
 public:
  static Result<std::unique_ptr<Window>> open(int width, int height, const std::string& title) {
    std::unique_ptr<Window> w(new Window);
    if (!glfwInit()) return w->failed("cannot open the display");
    w->initialised_ = true;
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    w->window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    if (!w->window_) return w->failed("cannot open a window with OpenGL 3.3");
    glfwMakeContextCurrent(w->window_);
    glfwSwapInterval(1);
    return w;
  }
  ~Window() override {
    if (window_) glfwDestroyWindow(window_);
    if (initialised_) glfwTerminate();
  }
  GLFWwindow* get() const { return window_; }

 private:
  Window() {
    complaint().clear();
    glfwSetErrorCallback([](int, const char* text) { complaint() = text; });
  }
  static std::string& complaint() {
    static std::string text;
    return text;
  }
  std::unexpected<Error> failed(const std::string& what) const {
    return fail(Fault::io, "", what + (complaint().empty() ? "" : ": " + complaint()),
                "check DISPLAY, or write pictures with --frames NAME.png");
  }
  GLFWwindow* window_ = nullptr;
  bool initialised_ = false;
};

// The window's state between frames. GLFW's callbacks find it by the window's user pointer.
class Viewer {
 public:
  Viewer(const Scene& scene, const CameraPath& path, const Options& options, const Plan& plan,
         LevelChoice& choice, Window& window)
      : scene_(scene),
        path_(path),
        plan_(plan),
        choice_(choice),
        window_(window.get()),
        orbit_(path.at(0)),
        look_(plan.look),
        playing_(!options.path.empty()),
        exit_after_(options.exit_after),
        renderer_name_(window.renderer()) {
    glfwSetWindowUserPointer(window_, this);
    glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int, int action, int) {
      if (action == GLFW_PRESS) self(w).key(key);
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* w, double, double y) { self(w).scroll(y); });
    glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) { self(w).move(x, y); });
    glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* w, int, int) { self(w).touch(); });
    glfwSetWindowRefreshCallback(window_, [](GLFWwindow* w) { self(w).touch(); });
  }

  Result<void> run(Statistics& statistics, Context& context);

 private:
  static Viewer& self(GLFWwindow* window) { return *static_cast<Viewer*>(glfwGetWindowUserPointer(window)); }
  void touch() { stale_ = true; }
  void key(int key);
  void level_key(int key);
  void scroll(double steps);
  void move(double x, double y);
  void take_over();
  Camera camera(std::uint64_t frame) const;
  Result<void> draw(Overlay& overlay, std::uint64_t frame, Statistics& statistics);
  void screenshot(int width, int height, const FramePlan& plan);

  const Scene& scene_;
  const CameraPath& path_;
  const Plan& plan_;
  LevelChoice& choice_;
  GLFWwindow* window_;
  std::unique_ptr<Renderer> renderer_;
  OrbitCamera orbit_;
  Look look_;
  bool playing_, stale_ = true, help_ = false, screenshot_wanted_ = false, fit_wanted_ = false;
  std::uint64_t exit_after_;
  double mouse_x_ = 0, mouse_y_ = 0;
  std::string renderer_name_, message_;
};

void Viewer::take_over() {
  playing_ = false;
  touch();
}

void Viewer::key(int key) {
  switch (key) {
    case GLFW_KEY_1:
      look_.show = Show::surface;
      break;
    case GLFW_KEY_2:
    case GLFW_KEY_3:
    case GLFW_KEY_4:
      if (!scene_.skeleton)
        message_ = "a mesh has no hierarchy to show";
      else
        look_.show = key == GLFW_KEY_2 ? Show::skeleton : key == GLFW_KEY_3 ? Show::both : Show::groups;
      break;
    case GLFW_KEY_MINUS:
    case GLFW_KEY_KP_SUBTRACT:
    case GLFW_KEY_EQUAL:
    case GLFW_KEY_KP_ADD:
    case GLFW_KEY_A:
      level_key(key);
      break;
    case GLFW_KEY_L:
      look_.lit = !look_.lit;
      break;
    case GLFW_KEY_G:
      look_.ground = !look_.ground;
      break;
    case GLFW_KEY_P:
      playing_ = !playing_;
      break;
    case GLFW_KEY_H:
      help_ = !help_;
      break;
    case GLFW_KEY_S:
      screenshot_wanted_ = true;
      break;
    case GLFW_KEY_F:
      fit_wanted_ = true;
      break;
    case GLFW_KEY_Q:
    case GLFW_KEY_ESCAPE:
      glfwSetWindowShouldClose(window_, GLFW_TRUE);
      break;
    default:
      return;
  }
  touch();
}

void Viewer::level_key(int key) {
  if (!scene_.levels)
    message_ = "there are no levels of detail: bake them with lodbake";
  else if (key == GLFW_KEY_A)
    choice_.choose_by_distance();
  else
    choice_.step(key == GLFW_KEY_MINUS || key == GLFW_KEY_KP_SUBTRACT ? 1 : -1);
}

void Viewer::scroll(double steps) {
  take_over();
  orbit_.approach(steps);
}

void Viewer::move(double x, double y) {
  int width = 1, height = 1;
  glfwGetWindowSize(window_, &width, &height);
  const double dx = (x - mouse_x_) / std::max(height, 1), dy = (y - mouse_y_) / std::max(height, 1);
  mouse_x_ = x;
  mouse_y_ = y;
  if (glfwGetMouseButton(window_, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS) {
    take_over();
    orbit_.turn(-4 * dx, 4 * dy);
  } else if (glfwGetMouseButton(window_, GLFW_MOUSE_BUTTON_RIGHT) == GLFW_PRESS ||
             glfwGetMouseButton(window_, GLFW_MOUSE_BUTTON_MIDDLE) == GLFW_PRESS) {
    take_over();
    orbit_.slide(-dx, dy);
  }
}

Camera Viewer::camera(std::uint64_t frame) const {
  return playing_ ? path_.at(path_.moment(frame % plan_.count, plan_.count)) : orbit_.camera();
}

// The first free name in the current folder; what happened is shown in the overlay.
void Viewer::screenshot(int width, int height, const FramePlan& plan) {
  std::filesystem::path name;
  for (int i = 1; name.empty() || std::filesystem::exists(name); ++i) {
    name = fmt::format("{}-{:04d}.png", std::filesystem::path(scene_.name).stem().string(), i);
  }
  auto done = renderer_->draw_picture(plan);
  if (done) done = write_image(name, renderer_->read_picture());
  message_ = done ? fmt::format("saved {} ({}x{})", name.string(), width, height) : done.error().what;
}

Result<void> Viewer::draw(Overlay& overlay, std::uint64_t frame, Statistics& statistics) {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  if (width < 1 || height < 1) return {};  // minimised
  const auto start = Clock::now();
  if (fit_wanted_) {
    const Camera c = camera(frame);
    orbit_.look(framing(scene_, static_cast<double>(width) / height, c.eye - c.target, c.fov));
    playing_ = fit_wanted_ = false;
  }
  if (playing_) orbit_.look(camera(frame));  // a touch of the mouse goes on from here
  const auto planned = renderer_->plan(camera(frame), look_, width, height, choice_);
  if (!planned) return std::unexpected(planned.error());
  const FramePlan& plan = *planned;
  const auto decided = Clock::now();
  if (auto done = renderer_->draw(plan, 0); !done) return done;
  glFinish();
  const auto finished = Clock::now();
  statistics.add(plan, seconds(start, decided), seconds(decided, finished));
  if (screenshot_wanted_) screenshot(width, height, plan);
  screenshot_wanted_ = false;
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, width, height);
  overlay.draw({&scene_, &plan, renderer_name_.c_str(), seconds(start, finished), message_.c_str(), help_,
                choice_.is_by_distance()});
  glfwSwapBuffers(window_);
  return {};
}

Result<void> Viewer::run(Statistics& statistics, Context& context) {
  Overlay overlay(window_);
  {
    Stage stage = context.stage("upload");
    auto made = Renderer::make(scene_, plan_.settings);
    if (!made) return std::unexpected(made.error());
    renderer_ = std::move(*made);
  }
  Stage stage = context.stage("frames");
  std::uint64_t frame = 0;
  while (!glfwWindowShouldClose(window_)) {
    // Nothing moves by itself unless a path is followed: wait for the user instead of drawing the same again.
    const bool wait = !stale_ && !playing_ && exit_after_ == 0;
    if (wait)
      glfwWaitEvents();
    else
      glfwPollEvents();
    if (wait && !stale_) continue;
    stale_ = false;
    if (auto done = draw(overlay, frame, statistics); !done) return done;
    if (++frame == exit_after_) break;
  }
  stage.items(frame, "frames");
  statistics.read(renderer_->read());
  return {};
}

}  // namespace

Result<void> run_viewer(const Scene& scene, const CameraPath& path, const Options& options, const Plan& plan,
                        LevelChoice& choice, Statistics& statistics, Context& context) {
  auto window = Window::open(plan.width, plan.height, "treeplay: " + scene.name);
  if (!window) return std::unexpected(window.error());
  context.report().options.emplace_back("renderer", (*window)->renderer());
  Viewer viewer(scene, path, options, plan, choice, **window);
  return viewer.run(statistics, context);
}

}  // namespace copse::treeplay
