#include "tools/treeplay/overlay.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

namespace copse::treeplay {

Overlay::Overlay(GLFWwindow* window) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // leaves no file behind
  ImGui::StyleColorsDark();
  ImGui::GetStyle().Colors[ImGuiCol_TextDisabled] = {0.78f, 0.8f, 0.82f, 1};
  ImGui::GetStyle().WindowRounding = 6;
  ImGui_ImplGlfw_InitForOpenGL(window, true);
  ImGui_ImplOpenGL3_Init("#version 330 core");
}

Overlay::~Overlay() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

namespace {

constexpr ImGuiWindowFlags k_panel = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                     ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav |
                                     ImGuiWindowFlags_NoInputs;

void level_line(const Overlay::Facts& facts) {
  const ShownLevel& shown = facts.plan->shown;
  const std::size_t last = facts.scene->levels->spectra().discrete.size();
  if (shown.impostor)
    ImGui::Text("impostor%s", facts.by_distance ? ", by distance" : "");
  else if (shown.number == k_none)
    ImGui::Text("level between 0 and %zu%s", last, facts.by_distance ? ", by distance" : "");
  else
    ImGui::Text("level %u of %zu%s", shown.number, last, facts.by_distance ? ", by distance" : "");
  ImGui::Text("errs by %.3g m at most, seen from %.4g m", static_cast<double>(shown.level.error),
              facts.plan->distance);
}

void facts_panel(const Overlay::Facts& facts) {
  ImGui::SetNextWindowPos({12, 12});
  ImGui::SetNextWindowBgAlpha(0.55f);
  ImGui::Begin("facts", nullptr, k_panel);
  const Scene& scene = *facts.scene;
  ImGui::TextUnformatted(scene.name.c_str());
  const double ms = facts.frame_seconds * 1e3;
  ImGui::Text("last frame: %.1f ms", ms);
  ImGui::Text("%llu triangles, %zu vertices", static_cast<unsigned long long>(scene.triangles()),
              scene.geometry.vertices.size());
  if (scene.skeleton) {
    ImGui::Text("%zu radii, %zu branch levels, %zu leaves in %zu groups", scene.skeleton->points.size(),
                std::size_t{scene.skeleton->levels}, scene.skeleton->leaves.size(),
                scene.skeleton->groups.size());
  }
  if (scene.levels) level_line(facts);
  ImGui::Text("drawn: %llu triangles, %llu lines, %llu points",
              static_cast<unsigned long long>(facts.plan->triangles),
              static_cast<unsigned long long>(facts.plan->lines),
              static_cast<unsigned long long>(facts.plan->points));
  ImGui::TextDisabled("%s", facts.renderer);
  if (*facts.message) ImGui::TextUnformatted(facts.message);
  ImGui::TextDisabled("H: help");
  ImGui::End();
}

void help_panel() {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowBgAlpha(0.8f);
  ImGui::Begin("help", nullptr, k_panel);
  ImGui::TextUnformatted(
      "drag, left     turn round the tree\n"
      "drag, right    slide\n"
      "wheel          nearer, farther\n"
      "F              fit the whole tree\n"
      "1 2 3 4        surface, skeleton, both, groups of leaves\n"
      "L              light on and off\n"
      "G              ground on and off\n"
      "- +            coarser, finer level of detail\n"
      "A              level by distance\n"
      "P              follow --path, stop\n"
      "S              screenshot into this folder\n"
      "H              this help\n"
      "Q, Esc         close");
  ImGui::End();
}

}  // namespace

void Overlay::draw(const Facts& facts) {
  ImGui_ImplOpenGL3_NewFrame();
  // Twice: a panel learns its size by being drawn, and the next picture may be long in coming.
  for (int pass = 0; pass < 2; ++pass) {
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    facts_panel(facts);
    if (facts.help) help_panel();
    ImGui::Render();
  }
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace copse::treeplay
