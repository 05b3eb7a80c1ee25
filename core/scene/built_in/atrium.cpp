// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include "core/scene/built_in/assembly.h"
#include "core/scene/built_in/atrium_parts.h"
#include "core/scene/camera.h"
#include "core/scene/mesh_builder.h"
#include "core/scene/scene.h"

namespace grisaille::scene {
namespace {

// The ground plan, in metres. Columns stand on the axes round an open court; the outer walls stand
// further out. Solids that meet overlap by centimetres, which keeps any two faces out of one plane.
constexpr double kBay = 2.4;
constexpr uint32_t kBaysX = 6, kBaysZ = 3;
constexpr double kAxisX = kBaysX * kBay / 2, kAxisZ = kBaysZ * kBay / 2;
constexpr double kWallX = 10, kWallZ = 6.2;  // inner faces of the outer walls
constexpr double kLowerSpring = 2.5, kLowerRadius = 0.92, kLowerThickness = 0.4;
constexpr double kGallery = 4.05;  // height of the gallery's floor
constexpr double kPedestal = 5.04, kUpperSpring = 6.3, kUpperRadius = 0.99, kUpperThickness = 0.32;
constexpr double kRoof = 7.45;  // height of the underside of the roof
constexpr double kVaultSpring = 2.72, kVaultRise = 0.85;

enum MaterialId : uint32_t {
  kStone,
  kPaleStone,
  kDarkStone,
  kTerracotta,
  kRed,
  kBlue,
  kLeaf,
  kSoil
};

class Atrium {
 public:
  Scene build() {
    addMaterials();
    addFloor();
    addWalls();
    addArcades();
    addColumns();
    addVaults();
    addCoffers();
    addBalustrade();
    addDais();
    addFurniture();
    addCloths();
    computeBounds(scene_);
    return std::move(scene_);
  }

 private:
  void addMaterials() {
    scene_.name = "atrium";
    scene_.textures.push_back({.name = "leaf",
                               .encoded = {},
                               .texels = leafTexture(),
                               .wrapU = Wrap::kClamp,
                               .wrapV = Wrap::kClamp});
    const auto plain = [&](const char* name, glm::vec3 color, bool doubleSided = false) {
      scene_.materials.push_back(
          {.name = name, .baseColor = glm::vec4(color, 1), .doubleSided = doubleSided});
    };
    plain("stone", {0.62f, 0.57f, 0.49f});
    plain("pale stone", {0.74f, 0.71f, 0.65f});
    plain("dark stone", {0.42f, 0.4f, 0.38f});
    plain("terracotta", {0.56f, 0.27f, 0.16f});
    plain("red cloth", {0.5f, 0.06f, 0.05f}, true);
    plain("blue cloth", {0.07f, 0.13f, 0.4f}, true);
    scene_.materials.push_back(
        {.name = "leaf", .baseColorTexture = 0, .masked = true, .doubleSided = true});
    plain("soil", {0.12f, 0.08f, 0.05f});
  }

  void place(uint32_t primitive, const glm::dmat4& transform = glm::dmat4(1)) {
    scene_.instances.push_back({.primitive = primitive, .worldFromObject = transform});
  }

  uint32_t add(const Solid& solid, MaterialId material, double crease) {
    return addPrimitive(scene_, solid, material, crease);
  }

  // Calls `f` with the transform of the centre of each bay. In local space the court lies at -z,
  // and the bay's corner axis at x = -kBay / 2.
  template <typename F>
  static void eachBay(F&& f) {
    for (uint32_t i = 0; i < kBaysX; ++i) {
      const double x = (i + 0.5) * kBay - kAxisX;
      f(moved({x, 0, kAxisZ}));
      f(moved({-x, 0, -kAxisZ}) * turned(0.5));
    }
    for (uint32_t i = 0; i < kBaysZ; ++i) {
      const double z = (i + 0.5) * kBay - kAxisZ;
      f(moved({kAxisX, 0, -z}) * turned(0.25));
      f(moved({-kAxisX, 0, z}) * turned(0.75));
    }
  }

  template <typename F>
  static void eachAxis(F&& f) {
    eachBay([&](const glm::dmat4& bay) { f(bay * moved({-kBay / 2, 0, 0})); });
  }

  void addFloor() {
    Solid bed = box({-kWallX - 0.2, -0.4, -kWallZ - 0.2}, {kWallX + 0.2, -0.03, kWallZ + 0.2});
    place(add(bed, kDarkStone, kCrease35));
    Solid tiles[2];
    constexpr double kTile = 1.0, kGap = 0.012;
    const auto cells = [](double extent) { return static_cast<int>(extent / kTile) + 1; };
    for (int i = -cells(kWallX); i < cells(kWallX); ++i) {
      for (int j = -cells(kWallZ); j < cells(kWallZ); ++j) {
        const auto seed = static_cast<uint32_t>((i + 64) * 128 + j + 64);
        const glm::dvec2 low =
            glm::max(glm::dvec2(i, j) * kTile + kGap, glm::dvec2(-kWallX - 0.1, -kWallZ - 0.1));
        const glm::dvec2 high = glm::min(glm::dvec2(i + 1, j + 1) * kTile - kGap,
                                         glm::dvec2(kWallX + 0.1, kWallZ + 0.1));
        if (high.x - low.x < 0.1 || high.y - low.y < 0.1) continue;
        const double top = 0.012 * hashUnit(seed);
        append(tiles[(i + j) & 1], box({low.x, -0.05, low.y}, {high.x, top, high.y}, 0.014));
      }
    }
    place(add(tiles[0], kPaleStone, kCrease35));
    place(add(tiles[1], kStone, kCrease35));
  }

  void addWalls() {
    const glm::dvec2 wall(kWallX, kWallZ), court(kAxisX, kAxisZ);
    const auto ring = [](double in, double low, double out, double high) {
      return std::array{glm::dvec2(in, low), glm::dvec2(in, high), glm::dvec2(out, high),
                        glm::dvec2(out, low)};
    };
    Solid walls = frame(ring(0, -0.3, -0.4, 7.95), wall);
    append(walls,
           frame(std::array{glm::dvec2(-0.1, -0.1), glm::dvec2(0.07, -0.1), glm::dvec2(0.07, 0.26),
                            glm::dvec2(0.03, 0.31), glm::dvec2(-0.1, 0.31)},
                 wall));
    append(walls, frame(ring(0.12, 3.8, -(kWallX - kAxisX) - 0.2, kGallery), court));
    append(walls, frame(ring(0.1, kRoof, -(kWallX - kAxisX) - 0.2, 7.8), court));
    append(walls, frame(ring(0.14, 7.75, -0.14, 8.05), court));
    place(add(walls, kStone, kCrease35));

    const auto cornice = [&](double y, double face) {
      constexpr glm::dvec2 kProfile[] = {{-0.3, 0},     {0.03, 0},    {0.03, 0.06}, {0.06, 0.09},
                                         {0.075, 0.13}, {0.11, 0.17}, {0.13, 0.2},  {0.13, 0.27},
                                         {0.15, 0.285}, {0.15, 0.34}, {-0.3, 0.34}};
      std::vector<glm::dvec2> profile;
      for (const glm::dvec2& point : kProfile) profile.emplace_back(point.x + face, point.y + y);
      return frame(profile, court);
    };
    Solid cornices = cornice(3.74, kLowerThickness / 2);
    append(cornices, cornice(7.52, kUpperThickness / 2));
    place(add(cornices, kPaleStone, kCrease35));
  }

  void addArcades() {
    const Arcade lower{.bays = kBaysX,
                       .bay = kBay,
                       .radius = kLowerRadius,
                       .spring = kLowerSpring,
                       .top = 3.85,
                       .thickness = kLowerThickness,
                       .overhang = 0.2};
    const Arcade upper{.bays = kBaysX,
                       .bay = kBay,
                       .radius = kUpperRadius,
                       .spring = kUpperSpring,
                       .top = 7.6,
                       .thickness = kUpperThickness,
                       .overhang = 0.16};
    Solid walls;
    for (Arcade arcade : {lower, upper}) {
      Solid side = arcadeWall(arcade);
      append(walls, side, moved({0, 0, kAxisZ}));
      append(walls, side, moved({0, 0, -kAxisZ}));
      // The short sides end inside the long ones.
      arcade.bays = kBaysZ;
      arcade.overhang = -0.1;
      arcade.top -= 0.01;
      side = arcadeWall(arcade);
      append(walls, side, moved({kAxisX, 0, 0}) * turned(0.25));
      append(walls, side, moved({-kAxisX, 0, 0}) * turned(0.25));
    }
    place(add(walls, kStone, kCrease35));
    const uint32_t lowerArch =
        add(archivolt(kLowerRadius, 0.16, kLowerThickness + 0.08), kPaleStone, kCrease35);
    const uint32_t upperArch =
        add(archivolt(kUpperRadius, 0.12, kUpperThickness + 0.07), kPaleStone, kCrease35);
    eachBay([&](const glm::dmat4& bay) {
      place(lowerArch, bay * moved({0, kLowerSpring, 0}));
      place(upperArch, bay * moved({0, kUpperSpring, 0}));
    });
  }

  void addColumns() {
    const uint32_t lower = add(flutedColumn(kLowerSpring + 0.03, 0.21), kPaleStone, kCrease35);
    const uint32_t upper =
        add(plainColumn(kUpperSpring - kPedestal + 0.04, 0.135), kPaleStone, kCrease35);
    const uint32_t pedestal =
        add(box({-0.22, 4.0, -0.22}, {0.22, kPedestal, 0.22}, 0.02), kStone, kCrease35);
    Solid pilaster = box({-0.2, -0.06, -0.16}, {0.2, kVaultSpring - 0.1, 0.1}, 0.012);
    append(pilaster, box({-0.25, -0.04, -0.21}, {0.25, 0.36, 0.1}, 0.02));
    append(pilaster,
           box({-0.25, kVaultSpring - 0.16, -0.21}, {0.25, kVaultSpring + 0.03, 0.1}, 0.02));
    const uint32_t onWall = add(pilaster, kPaleStone, kCrease35);
    eachAxis([&](const glm::dmat4& axis) {
      place(lower, axis * moved({0, -0.01, 0}));
      place(upper, axis * moved({0, kPedestal - 0.02, 0}));
      place(pedestal, axis);
    });
    for (uint32_t i = 0; i <= kBaysX; ++i) {
      const double x = i * kBay - kAxisX;
      place(onWall, moved({x, 0, kWallZ}));
      place(onWall, moved({x, 0, -kWallZ}) * turned(0.5));
    }
    for (uint32_t i = 0; i <= kBaysZ; ++i) {
      const double z = i * kBay - kAxisZ;
      place(onWall, moved({kWallX, 0, z}) * turned(0.25));
      place(onWall, moved({-kWallX, 0, z}) * turned(0.75));
    }
  }

  // Groined vaults over the lower walk, with ribs between them.
  void addVaults() {
    constexpr double kGap = 0.02;  // hidden in the ribs
    const auto quartic = [](double t) { return 1 - t * t * t * t; };
    const Height lower = [&](double u, double v) {
      return kVaultSpring + kVaultRise * std::max(quartic(u), quartic(v));
    };
    const Height upper = [](double, double) { return 3.83; };
    const double depthX = kWallX + 0.05 - kAxisX - 0.17, depthZ = kWallZ + 0.05 - kAxisZ - 0.17;
    const auto vault = [&](double width, double depth) {
      return add(slab({-width / 2 + kGap, -depth / 2 + kGap}, {width / 2 - kGap, depth / 2 - kGap},
                      10, lower, upper),
                 kPaleStone, kCrease35);
    };
    const auto rib = [&](double depth) {
      std::vector<Ring> rings;
      constexpr int kSteps = 12;
      for (int i = 0; i <= kSteps; ++i) {
        const double t = 2.0 * i / kSteps - 1, x = t * depth / 2;
        const double y = kVaultSpring - 0.08 + (kVaultRise + 0.02) * quartic(t);
        rings.push_back({{x, y, 0.11}, {x, 3.82, 0.11}, {x, 3.82, -0.11}, {x, y, -0.11}});
      }
      return add(loft(rings, false), kStone, kCrease35);
    };
    const double middleX = kAxisX + 0.17 + depthX / 2, middleZ = kAxisZ + 0.17 + depthZ / 2;
    const uint32_t longSide = vault(kBay, depthZ), shortSide = vault(depthX, kBay),
                   corner = vault(depthX + 0.02, depthZ + 0.02), ribX = rib(depthX),
                   ribZ = rib(depthZ);
    for (const double side : {-1.0, 1.0}) {
      for (uint32_t i = 0; i < kBaysX; ++i) {
        place(longSide, moved({(i + 0.5) * kBay - kAxisX, 0, side * middleZ}));
      }
      for (uint32_t i = 0; i < kBaysZ; ++i) {
        place(shortSide, moved({side * middleX, 0, (i + 0.5) * kBay - kAxisZ}));
      }
      for (uint32_t i = 0; i <= kBaysX; ++i) {
        place(ribZ, moved({i * kBay - kAxisX, 0, side * middleZ}) * turned(0.25));
      }
      for (uint32_t i = 0; i <= kBaysZ; ++i) {
        place(ribX, moved({side * middleX, 0, i * kBay - kAxisZ}));
      }
      place(corner, moved({middleX, 0, side * middleZ}));
      place(corner, moved({-middleX, 0, side * middleZ}));
    }
  }

  // Beams under the gallery's roof.
  void addCoffers() {
    Solid beams;
    const glm::dvec2 axis(kAxisX, kAxisZ), wall(kWallX, kWallZ);
    const auto along = [&](double share, double half, double bottom) {
      const glm::dvec2 middle = glm::mix(axis, wall, share);
      append(beams,
             frame(std::array{glm::dvec2(-half, bottom), glm::dvec2(half, bottom),
                              glm::dvec2(half, kRoof + 0.04), glm::dvec2(-half, kRoof + 0.04)},
                   middle));
    };
    along(0.34, 0.06, 7.31);
    along(0.67, 0.06, 7.31);
    along(0.99, 0.16, 7.2);
    const auto across = [&](double x, double half, double bottom) {
      for (const double side : {-1.0, 1.0}) {
        append(beams,
               box({x - half, bottom, std::min(side * kAxisZ, side * (kWallZ + 0.05))},
                   {x + half, kRoof + 0.05, std::max(side * kAxisZ, side * (kWallZ + 0.05))}));
      }
    };
    for (uint32_t i = 0; i <= 3 * kBaysX; ++i) {
      across(i * kBay / 3 - kAxisX, i % 3 == 0 ? 0.1 : 0.05, i % 3 == 0 ? 7.26 : 7.33);
    }
    for (uint32_t i = 0; i <= 3 * kBaysZ; ++i) {
      const double z = i * kBay / 3 - kAxisZ, half = i % 3 == 0 ? 0.1 : 0.05;
      const double bottom = i % 3 == 0 ? 7.27 : 7.34;
      append(beams, box({kAxisX, bottom, z - half}, {kWallX + 0.05, kRoof + 0.06, z + half}));
      append(beams, box({-kWallX - 0.05, bottom, z - half}, {-kAxisX, kRoof + 0.06, z + half}));
    }
    place(add(beams, kTerracotta, kCrease35));
  }

  void addBalustrade() {
    const glm::dvec2 court(kAxisX, kAxisZ);
    Solid rails =
        frame(std::array{glm::dvec2(-0.1, 3.98), glm::dvec2(0.1, 3.98), glm::dvec2(0.1, 4.2),
                         glm::dvec2(0.08, 4.22), glm::dvec2(-0.08, 4.22), glm::dvec2(-0.1, 4.2)},
              court);
    append(rails,
           frame(std::array{glm::dvec2(-0.09, 4.84), glm::dvec2(0.09, 4.84), glm::dvec2(0.14, 4.9),
                            glm::dvec2(0.14, 4.96), glm::dvec2(0.11, 4.99), glm::dvec2(-0.11, 4.99),
                            glm::dvec2(-0.14, 4.96), glm::dvec2(-0.14, 4.9)},
                 court));
    place(add(rails, kPaleStone, kCrease35));
    const uint32_t post = add(baluster(0.66), kPaleStone, kCrease60);
    constexpr int kPosts = 5;
    eachBay([&](const glm::dmat4& bay) {
      for (int i = 0; i < kPosts; ++i) {
        place(post, bay * moved({(i + 0.5 - kPosts / 2.0) * 0.37, 4.2, 0}));
      }
    });
  }

  void addDais() {
    Solid steps;
    for (int i = 0; i < 3; ++i) {
      append(steps, box({3.5 + 0.36 * i, -0.06, -2.4 + 0.36 * i},
                        {6.72 - 0.02 * i, 0.16 * (i + 1), 2.4 - 0.36 * i}, 0.02));
    }
    place(add(steps, kPaleStone, kCrease35));
    Solid plinth = box({5.15, 0.45, -0.45}, {6.05, 0.62, 0.45}, 0.025);
    append(plinth, box({5.24, 0.6, -0.36}, {5.96, 1.3, 0.36}, 0.02));
    append(plinth, box({5.17, 1.28, -0.43}, {6.03, 1.4, 0.43}, 0.03));
    place(add(plinth, kStone, kCrease35));
  }

  void addFurniture() {
    const uint32_t tall = add(vase(1.25), kTerracotta, kCrease60);
    const uint32_t small = add(vase(0.75), kTerracotta, kCrease60);
    place(tall, moved({5.6, 1.39, 0}));
    place(tall, moved({-2.9, 0.006, -2.5}));
    place(small, moved({-2.2, 0.006, -2.75}));
    place(small, moved({3.0, 0.006, 2.75}));
    place(small, moved({4.1, 0.47, -1.5}) * turned(0.1));

    const uint32_t tub = add(pot(0.3), kTerracotta, kCrease60);
    const uint32_t earth =
        add(lathe(std::array{glm::dvec2(0.2, 0.3), glm::dvec2(0.245, 0.36), glm::dvec2(0.1, 0.385)},
                  20),
            kSoil, kCrease60);
    const uint32_t plants[] = {add(plant(26, 0.95, 1), kLeaf, kNoCrease),
                               add(plant(22, 0.75, 2), kLeaf, kNoCrease)};
    const glm::dvec3 spots[] = {{-3.9, 0.005, -2.2}, {-0.2, 0.005, -2.85},
                                {2.6, 0.005, -2.6},  {6.2, 0.47, -1.3},
                                {6.2, 0.47, 1.3},    {-0.6, 0.005, 2.85},
                                {-6.6, 0.005, -2.9}, {1.2, kGallery - 0.005, -4.6}};
    for (size_t i = 0; i < std::size(spots); ++i) {
      const glm::dmat4 spot = moved(spots[i]) * turned(0.17 * static_cast<double>(i));
      place(tub, spot);
      place(earth, spot);
      place(plants[i % 2], spot * moved({0, 0.36, 0}));
    }
    const uint32_t seat = add(bench(1.7), kStone, kCrease35);
    place(seat, moved({0.9, 0.003, -2.55}));
    place(seat, moved({-2.4, 0.003, 2.6}) * turned(0.5));
    place(seat, moved({2.4, 0.003, -5.6}));
    place(seat, moved({-2.4, 0.003, 5.6}));
  }

  void addCloths() {
    const uint32_t red = add(drape(1.55, 2.3, 0.2), kRed, kNoCrease);
    place(red, moved({-1.2, 4.86, -kAxisZ}));
    place(red, moved({3.6, 4.86, -kAxisZ}));
    // The rods rest in the walls of the upper arcade.
    const uint32_t blue = add(banner(1.7, 2.3), kBlue, kNoCrease);
    Solid rods;
    const std::array rod{glm::dvec2(0.03, -kAxisZ), glm::dvec2(0.03, kAxisZ)};
    glm::dmat4 lay(1);  // turns +y to +z
    lay[1] = {0, 0, 1, 0};
    lay[2] = {0, -1, 0, 0};
    for (const double x : {0.0, 4.8}) {
      append(rods, lathe(rod, 16), moved({x, 6.55, 0}) * lay);
      place(blue, moved({x, 6.51, x > 1 ? 0.9 : -0.4}) * turned(0.25));
    }
    place(add(rods, kDarkStone, kCrease60));
  }

  Scene scene_;
};

}  // namespace

Scene makeAtrium() {
  Scene scene = Atrium().build();
  scene.camera = atriumCamera();
  return scene;
}

Camera atriumCamera() {
  return {.eye = {-6.5, 1.75, 1.9}, .target = {2.6, 2.35, -1.2}, .fovyDegrees = 62};
}

}  // namespace grisaille::scene
