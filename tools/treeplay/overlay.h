// What is written over the picture, through Dear ImGui.
#pragma once

#include "tools/treeplay/renderer.h"

struct GLFWwindow;

namespace copse::treeplay {

class Overlay {
 public:
  explicit Overlay(GLFWwindow* window);  // with a current context; keeps the callbacks that are set
  ~Overlay();
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;

  struct Facts {
    const Scene* scene = nullptr;
    const FramePlan* plan = nullptr;
    const char* renderer = "";
    double frame_seconds = 0;  // of this frame, without the overlay
    const char* message = "";  // of the last action
    bool help = false;
    bool by_distance = false;  // the level is
  };
  void draw(const Facts& facts);
};

}  // namespace copse::treeplay
