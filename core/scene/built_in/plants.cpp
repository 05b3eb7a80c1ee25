// SPDX-License-Identifier: MIT
#include "core/scene/built_in/plants.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/scene/built_in/shapes.h"

namespace grisaille::scene {
namespace {

// Random numbers in a row. The order of arguments and operands is the compiler's choice: no
// expression may ask twice.
class Dice {
 public:
  explicit Dice(uint32_t seed) : next_(seed * 1000003u) {}
  double between(double low, double high) { return hashBetween(next_++, low, high); }
  // A vector in the cube from -1 to 1.
  glm::dvec3 vector() {
    const double x = between(-1, 1), y = between(-1, 1), z = between(-1, 1);
    return {x, y, z};
  }

 private:
  uint32_t next_;
};

// A card from its stem at `from` along `direction`, bent downwards by a share of its length.
// facing: about its normal
void addCard(Solid& leaves, const glm::dvec3& from, const glm::dvec3& direction,
             const glm::dvec3& facing, const glm::dvec2& size, double droop) {
  const glm::dvec3 along = glm::normalize(direction);
  const glm::dvec3 side = glm::normalize(glm::cross(along, facing));
  const glm::dvec3 normal = glm::cross(side, along);
  append(leaves, sheet(1, droop > 0 ? 2 : 1, [&](double u, double v) {
           const double t = 1 - v;
           return from + along * (size.y * t) + side * (size.x * (u - 0.5)) -
                  normal * (droop * size.y * t * t);
         }));
}

// Turns `direction` away by about `spread` (0 ... 1, as a share of a right angle), to the side that
// `turn` names.
glm::dvec3 branchOff(const glm::dvec3& direction, double spread, double turn) {
  const glm::dmat4 frame = aimed({}, direction);
  const glm::dvec3 out =
      cosTurns(turn) * glm::dvec3(frame[0]) + sinTurns(turn) * glm::dvec3(frame[2]);
  return glm::normalize((1 - spread) * glm::dvec3(frame[1]) + spread * out);
}

class Grower {
 public:
  Grower(const TreeForm& form, uint32_t seed) : form_(form), dice_(seed) {}

  Plant grow() {
    const uint32_t steps = 9;
    Path trunk;
    std::vector<double> radii;
    glm::dvec3 at(0, -0.25, 0), drift(0);
    for (uint32_t k = 0; k <= steps; ++k) {
      const double t = static_cast<double>(k) / steps;
      trunk.push_back(at);
      const double flare = 1 + 0.7 * (1 - smoothUnit(t * 4));
      radii.push_back(form_.radius * flare * (1 - 0.86 * t));
      drift = 0.7 * drift + 0.05 * dice_.vector();
      at += (form_.height + 0.25) / steps * (glm::dvec3(0, 1, 0) + drift * glm::dvec3(1, 0, 1));
    }
    append(plant_.wood, tube(trunk, radii, 12));
    const double first = form_.clear / form_.height;
    for (uint32_t k = 0; k < form_.branches; ++k) {
      const double share = (k + dice_.between(0.2, 0.8)) / form_.branches;
      const double t = first + (0.97 - first) * share;
      const double turn = 0.382 * k + dice_.between(0, 0.12);
      const double length = form_.reach * (1 - 0.6 * share) * dice_.between(0.85, 1.15);
      addBranch(pointOf(trunk, t), branchOff({0, 1, 0}, 0.72 - 0.35 * share, turn), length,
                std::max(0.35 * form_.radius * (1.1 - share), 0.016));
    }
    addTwig(pointOf(trunk, 0.95), {0, 1, 0}, form_.reach * 0.35, 0.014);
    return std::move(plant_);
  }

 private:
  static glm::dvec3 pointOf(const Path& path, double t) {
    const double along = t * static_cast<double>(path.size() - 1);
    const size_t i = std::min(static_cast<size_t>(along), path.size() - 2);
    return glm::mix(path[i], path[i + 1], along - static_cast<double>(i));
  }

  // A tube that wanders and rises towards the light.
  Path addWood(const glm::dvec3& from, glm::dvec3 direction, double length, double radius,
               uint32_t steps, uint32_t sides) {
    Path path{from};
    std::vector<double> radii{radius};
    for (uint32_t k = 1; k <= steps; ++k) {
      direction = glm::normalize(direction + 0.16 * dice_.vector() + glm::dvec3(0, 0.12, 0));
      path.push_back(path.back() + length / steps * direction);
      radii.push_back(radius * (1 - 0.75 * k / steps));
    }
    append(plant_.wood, tube(path, radii, sides));
    return path;
  }

  void addBranch(const glm::dvec3& from, const glm::dvec3& direction, double length,
                 double radius) {
    const Path path = addWood(from, direction, length, radius, 5, 7);
    constexpr uint32_t kTwigs = 5;
    for (uint32_t k = 0; k < kTwigs; ++k) {
      const double t = 0.35 + 0.65 * (k + dice_.between(0.3, 1)) / kTwigs;
      const double turn = 0.5 * k + dice_.between(0, 0.3), share = dice_.between(0.35, 0.5);
      const size_t i = std::min<size_t>(static_cast<size_t>(t * 5), 4);
      const glm::dvec3 along = glm::normalize(path[i + 1] - path[i]);
      addTwig(pointOf(path, std::min(t, 0.98)), branchOff(along, 0.5, turn), length * share,
              std::max(radius * 0.4, 0.007));
    }
  }

  void addTwig(const glm::dvec3& from, const glm::dvec3& direction, double length, double radius) {
    const Path path = addWood(from, direction, length, radius, 3, 5);
    for (uint32_t k = 0; k < form_.cardsPerTwig; ++k) {
      const double t = 0.15 + 0.83 * (k + dice_.between(0, 0.9)) / form_.cardsPerTwig;
      const glm::dvec3 along = glm::normalize(path[3] - path[0]);
      const double spread = dice_.between(0.3, 0.75);
      glm::dvec3 out = branchOff(along, spread, dice_.between(0, 1));
      out.y -= 0.25;
      const double size = form_.card * dice_.between(0.7, 1.15);
      const glm::dvec3 facing = glm::dvec3(0, 1, 0) + 0.6 * dice_.vector();
      addCard(plant_.leaves, pointOf(path, t), out, facing, {0.85 * size, size}, 0);
    }
  }

  TreeForm form_;
  Dice dice_;
  Plant plant_;
};

}  // namespace

Plant tree(const TreeForm& form, uint32_t seed) {
  return Grower(form, seed).grow();
}

Plant hedge(const glm::dvec3& size, uint32_t cards, uint32_t seed) {
  Plant plant;
  Dice dice(seed);
  const uint32_t stems = static_cast<uint32_t>(size.x / 0.3);
  for (uint32_t k = 0; k < stems; ++k) {
    const double x = (k + dice.between(0.1, 0.9)) / stems * size.x - size.x / 2;
    const glm::dvec3 foot(x, -0.1, dice.between(-0.1, 0.1) * size.z);
    for (int arm = 0; arm < 2; ++arm) {
      const double leanX = dice.between(-0.25, 0.25), leanZ = dice.between(-0.4, 0.4);
      const glm::dvec3 lean(leanX, 0, leanZ * size.z);
      const double rise = size.y * dice.between(0.65, 0.9);
      const Path path =
          curve(std::array{foot + 0.05 * lean, foot + glm::dvec3(0, 0.4 * rise, 0) + 0.3 * lean,
                           foot + glm::dvec3(0, rise, 0) + lean},
                2);
      append(plant.wood, tube(path, std::array{0.014, 0.012, 0.01, 0.007, 0.004}, 5));
    }
  }
  for (uint32_t k = 0; k < cards; ++k) {
    // A point of the surface of a rounded box, and a little below it.
    glm::dvec3 unit = dice.vector();
    const glm::dvec3 side = glm::abs(unit);
    const int axis = dice.between(0, 1) < 0.27 ? 1 : 2;  // the top, or the front and the back
    if (axis == 1) unit.y = 1;
    if (axis == 2) unit.z = unit.z < 0 ? -1 : 1;
    if (side.x > 0.97) unit.x = unit.x < 0 ? -1 : 1;
    const double under = dice.between(0.7, 1);
    const double bulge = 1 + 0.12 * noise(2.2 * unit.x * size.x, 2 * unit.y, seed);
    const glm::dvec3 at(unit.x * size.x / 2 * (0.94 + 0.06 * under),
                        size.y * (0.53 + 0.47 * unit.y * (axis == 1 ? under : 0.96)) * bulge,
                        unit.z * size.z / 2 * (axis == 2 ? under : 0.9) * bulge);
    glm::dvec3 out = 0.8 * dice.vector() + glm::dvec3(0, 0.35, 0);
    out[axis] += unit[axis] < 0 ? -0.8 : 0.8;
    const double length = dice.between(0.15, 0.23);
    addCard(plant.leaves, at - 0.4 * length * glm::normalize(out), out,
            glm::dvec3(0, 1, 0.2) + 0.9 * dice.vector(), {length * 0.95, length}, 0);
  }
  return plant;
}

Solid grass(uint32_t blades, double radius, double height, uint32_t seed) {
  Solid solid;
  Dice dice(seed);
  for (uint32_t k = 0; k < blades; ++k) {
    const double turn = dice.between(0, 1), away = radius * dice.between(0, 1);
    const glm::dvec3 out(cosTurns(turn), 0, sinTurns(turn));
    const glm::dvec3 foot = away * out - glm::dvec3(0, 0.03, 0);
    const double outwards = dice.between(0.1, 0.75);
    const glm::dvec3 lean = outwards * out + 0.25 * dice.vector();
    const double tall = height * dice.between(0.5, 1.1);
    const double width = dice.between(0.003, 0.007);
    const double face = turn + dice.between(0.15, 0.35);
    const glm::dvec3 side(width * cosTurns(face), 0, width * sinTurns(face));
    const auto base = static_cast<uint32_t>(solid.positions.size());
    const auto at = [&](double t) {
      return foot +
             tall * (glm::dvec3(0, t * (1 - 0.25 * t), 0) + t * t * lean * glm::dvec3(1, 0, 1));
    };
    for (const double t : {0.0, 0.55}) {
      const double share = 1 - 0.35 * t;
      solid.positions.push_back(at(t) - share * side);
      solid.positions.push_back(at(t) + share * side);
    }
    solid.positions.push_back(at(1));
    for (const uint32_t i : {0u, 1u, 3u, 0u, 3u, 2u, 2u, 3u, 4u}) solid.indices.push_back(base + i);
  }
  solid.texCoords.resize(solid.positions.size(), glm::dvec2(0));
  return solid;
}

}  // namespace grisaille::scene
