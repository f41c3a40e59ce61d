#include "tests/benchmarks/peers/models.h"

#include <cmath>
#include <random>

namespace blocklift::peers {

namespace {

constexpr Rotation identity{1, 0, 0, 0, 1, 0, 0, 0, 1};

TreeBody link(int number) {
  TreeBody body;
  body.axis = number % 2 == 0 ? Triple{0, 0, 1} : Triple{0, 1, 0};
  body.R_PB = identity;
  body.p_PB = {1, 0, 0};
  body.mass = 1;
  body.p_BoBcm = {0.5, 0.03, -0.02};
  body.I_BBcm = {0.02,   0.002, -0.001,  //
                 0.002,  0.09,  0.003,   //
                 -0.001, 0.003, 0.085};
  return body;
}

Rotation rotation(const std::array<double, 4>& quaternion) {
  const auto [w, x, y, z] = quaternion;
  return {1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
          2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
          2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
}

}  // namespace

TreeModel chain(int count) {
  TreeModel model{"chain of " + std::to_string(count), {}};
  for (int i = 0; i < count; ++i) {
    TreeBody body = link(i);
    body.parent = i - 1;
    if (i == 0) body.p_PB = {0, 0, 0};
    model.bodies.push_back(body);
  }
  return model;
}

TreeModel floating_tree() {
  TreeModel model{"floating tree", {}};
  TreeBody base;
  base.free = true;
  base.R_PB = identity;
  base.mass = 10;
  base.I_BBcm = identity;
  model.bodies.push_back(base);
  for (int arm = 0; arm < 5; ++arm) {
    const double angle = 2 * M_PI * arm / 5;
    const double c = std::cos(angle), s = std::sin(angle);
    for (int i = 0; i < 6; ++i) {
      TreeBody body = link(i);
      body.parent = static_cast<int>(model.bodies.size()) - 1;
      if (i == 0) {
        body.parent = 0;
        body.R_PB = {c, -s, 0, s, c, 0, 0, 0, 1};
        body.p_PB = {0.3 * c, 0.3 * s, 0};
      }
      model.bodies.push_back(body);
    }
  }
  return model;
}

TreeState some_state(const TreeModel& model, unsigned number) {
  std::mt19937 engine(number);
  std::uniform_real_distribution<double> uniform(-1, 1);
  TreeState state;
  for (auto* values : {&state.q, &state.v, &state.tau}) {
    for (std::size_t i = 0; i < model.joint_count(); ++i) values->push_back(uniform(engine));
  }
  state.quaternion = {1, 0, 0, 0};
  if (model.floats()) {
    double square = 0;
    for (double& e : state.quaternion) e = uniform(engine), square += e * e;
    for (double& e : state.quaternion) e /= std::sqrt(square);
    for (auto* triple : {&state.p_WB, &state.w_WB, &state.v_WB}) {
      for (double& e : *triple) e = uniform(engine);
    }
  }
  state.R_WB = rotation(state.quaternion);
  return state;
}

}  // namespace blocklift::peers
