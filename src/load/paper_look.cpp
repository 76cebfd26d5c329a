#include "load/paper_look.h"

namespace splotchcl {

void change_to_paper(Scene& scene) {
  for (Component& component : scene.components) {
    if (component.brightness == 0) continue;  // dust is ink as it is
    component.absorption = {Absorption::Kind::factor, component.brightness};
    component.brightness = 0;
    component.color_vector.clear();
    component.palette = component.color.field.empty() ? "white" : "ink";
  }
  scene.image.background = {1, 1, 1};
  scene.finish = FinishSettings();
  scene.finish.text_color = {0, 0, 0};
}

}  // namespace splotchcl
