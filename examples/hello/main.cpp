// The least there is: a ball on mud, and how deep it sank.
#include <divot/divot.h>

#include <iostream>

int main() {
  divot::Scene scene;
  scene.terrain = {.shape = divot::GridTerrain{.columns = 81, .rows = 81, .spacing = 0.1}, .material = "mud"};
  scene.bodies = {{.name = "ball", .shape = divot::Sphere{0.5}, .mass = 600, .above_ground = true}};
  auto world = divot::World::create(scene);
  if (!world) {
    for (const divot::Error& error : world.error()) std::cerr << error.text() << '\n';
    return 1;
  }
  while (world->time() < 2) world->step();
  std::cout << "The ball sank " << world->bodies().front().sinkage << " m.\n";
}
