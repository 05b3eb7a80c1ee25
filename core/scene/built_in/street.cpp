// SPDX-License-Identifier: MIT
// A street of town houses, with parked cars.
#include <array>

#include "core/scene/built_in/assembly.h"
#include "core/scene/built_in/scenes.h"
#include "core/scene/built_in/shapes.h"
#include "core/scene/built_in/street_parts.h"

namespace grisaille::scene {
namespace {

constexpr double kStreetLength = 50, kRoad = 3.4,
                 kHouseFront = 6.1;  // half widths of the road, of the street
constexpr double kPavement = 0.13;   // height above the gutter

class Street {
 public:
  Scene build() {
    addRoad();
    addHouses();
    addCars();
    addFurniture();
    addCables();
    return scene_.finish(
        {.eye = {-19.5, 1.72, 4.55}, .target = {-6, 2.3, -1.2}, .fovyDegrees = 62});
  }

 private:
  void addRoad() {
    const double half = kStreetLength / 2;
    const auto camber = [](double x, double z) {
      const double t = z / kRoad;
      return 0.09 * (1 - t * t) - 0.01 + 0.006 * noise(1.3 * x, 1.3 * z, 5);
    };
    scene_.put(ground({-half - 1, -kRoad - 0.15}, {half + 1, kRoad + 0.15}, {36, 6}, -0.5, camber),
               asphalt_, kCrease60);
    Solid kerbs, slabs, bed;
    for (const double side : {-1.0, 1.0}) {
      const glm::dmat4 turn = turned(side > 0 ? 0 : 0.5);  // the pavement at +z
      for (uint32_t k = 0; k < 30; ++k) {
        const double x = half * (k / 15.0 - 1), top = kPavement + hashBetween(k, -0.006, 0.006);
        append(kerbs,
               box({x + 0.006, -0.3, kRoad}, {x + half / 15 - 0.006, top, kRoad + 0.16}, 0.025),
               turn);
      }
      for (uint32_t k = 0; k < 25 * 2; ++k) {
        const double x = (k % 25) * 2.0 - half + (k < 25 ? 0 : 0.9), z = k < 25 ? 0.168 : 1.422;
        const double top = kPavement - 0.004 + hashBetween(k + 99, -0.005, 0.005);
        append(slabs, box({x + 0.005, 0, kRoad + z}, {x + 1.995, top, kRoad + z + 1.244}, 0.008),
               turn);
      }
      append(
          bed,
          box({-half - 1.1, -0.5, kRoad + 0.1}, {half + 1.1, kPavement - 0.02, kHouseFront + 0.3}),
          turn);
    }
    scene_.put(kerbs, stone_);
    scene_.put(slabs, stone_);
    scene_.put(bed, asphalt_);
    Solid covers;
    for (const glm::dvec2& at :
         {glm::dvec2(-14.2, 0.6), glm::dvec2(-3, -1.2), glm::dvec2(9, 0.9)}) {
      const double y = camber(at.x, at.y);
      append(covers,
             lathe(std::array{glm::dvec2(0.42, -0.1), glm::dvec2(0.42, 0.012),
                              glm::dvec2(0.37, 0.014), glm::dvec2(0.36, -0.006),
                              glm::dvec2(0.34, 0.008), glm::dvec2(0.1, 0.009)},
                   24),
             moved({at.x, y, at.y}));
    }
    scene_.put(covers, iron_);
  }

  void addHouses() {
    struct Plot {
      double width;
      HouseForm form;
      uint32_t plaster;
    };
    // The widths of a side add up to the street's length.
    constexpr uint32_t kHousesOfASide = 5;
    const Plot plots[] = {
        {10.2, {.storeys = 3, .windows = 3, .shop = true}, 0},
        {8.6, {.storeys = 2, .windows = 3}, 1},
        {11.4, {.storeys = 3, .windows = 4, .balconies = true, .pitched = false}, 2},
        {9.2, {.storeys = 2, .windows = 2, .shop = true}, 3},
        {10.6, {.storeys = 2, .windows = 3, .balconies = true}, 1},
        {10.8, {.storeys = 2, .windows = 3, .shop = true}, 2},
        {10.4, {.storeys = 3, .windows = 3, .balconies = true}, 3},
        {8.4, {.storeys = 2, .windows = 2, .pitched = false}, 1},
        {10.6, {.storeys = 2, .windows = 3, .shop = true}, 0},
        {9.8, {.storeys = 3, .windows = 2}, 2},
    };
    double x = -kStreetLength / 2;
    for (uint32_t k = 0; k < std::size(plots); ++k) {
      if (k == kHousesOfASide) x = -kStreetLength / 2;
      HouseForm form = plots[k].form;
      form.width = plots[k].width + 0.04;
      form.depth = 8 + 0.3 * hashUnit(k);
      form.storey = 2.95 + 0.3 * hashUnit(k + 20);
      const House made = house(form, k + 3);
      const double front = kHouseFront + 0.12 * hashUnit(k + 40);
      const glm::dmat4 turn = turned(k < kHousesOfASide ? 0 : 0.5);
      const glm::dmat4 place = turn * moved({x + plots[k].width / 2, kPavement, -front});
      x += plots[k].width;
      addHouse(made, plots[k].plaster, k, place);
      addAwnings(made, place, k % 2 == 0 ? red_ : sand_);
    }
    // One more closes the view.
    addHouse(house({.width = 14.5, .storeys = 2, .windows = 3}, 60), 3, 1,
             moved({kStreetLength / 2 + 0.4, kPavement, 0}) * turned(0.75));
  }

  void addHouse(const House& house, uint32_t plaster, uint32_t number, const glm::dmat4& place) {
    scene_.place(scene_.add(house.walls, plaster_[plaster]), place);
    scene_.place(scene_.add(house.trim, trim_), place);
    scene_.place(scene_.add(house.glass, glass_), place);
    scene_.place(scene_.add(house.metal, number % 2 == 0 ? iron_ : green_), place);
    if (!house.roof.indices.empty()) scene_.place(scene_.add(house.roof, tiles_), place);
  }

  void addCars() {
    const Car models[] = {car(4.25, false), car(3.8, false), car(4.9, true)};
    constexpr glm::vec3 kColours[] = {
        {0.45f, 0.06f, 0.05f}, {0.1f, 0.2f, 0.35f}, {0.7f, 0.7f, 0.68f}};
    struct Part {
      uint32_t glass, tyres, metal, body;
    };
    std::array<Part, 3> parts{};
    for (size_t k = 0; k < 3; ++k) {
      parts[k] = {.glass = scene_.add(models[k].glass, glass_, kCrease35),
                  .tyres = scene_.add(models[k].tyres, rubber_, kCrease35),
                  .metal = scene_.add(models[k].metal, iron_, kCrease35),
                  .body = scene_.add(models[k].body, scene_.plain("car", kColours[k]), kCrease60)};
    }
    struct Place {
      size_t model;
      double x, z, turn;
    };
    constexpr Place kPlaces[] = {{0, -12.8, -2.35, 0.002},
                                 {2, -6.2, -2.4, 0.5},
                                 {1, -10.2, 2.4, 0.5},
                                 {0, 4.6, 2.35, 0.498}};
    for (const Place& at : kPlaces) {
      const glm::dmat4 place = moved({at.x, 0.03, at.z}) * turned(at.turn);
      for (const uint32_t part : {parts[at.model].glass, parts[at.model].tyres,
                                  parts[at.model].metal, parts[at.model].body}) {
        scene_.place(part, place);
      }
    }
  }

  void addFurniture() {
    const uint32_t lamp = scene_.add(lampPost(4.4), iron_, kCrease60);
    const uint32_t post = scene_.add(bollard(), iron_, kCrease60);
    const uint32_t basket = scene_.add(bin(), green_, kCrease35);
    const uint32_t stand = scene_.add(bicycleStand(), iron_, kCrease60);
    const StreetBench bench = streetBench(1.8);
    const uint32_t slats = scene_.add(bench.slats, wood_),
                   irons = scene_.add(bench.irons, iron_, kCrease60);
    for (const double side : {-1.0, 1.0}) {
      const glm::dmat4 turn = turned(side > 0 ? 0 : 0.5);
      const auto at = [&](double x, double z) { return turn * moved({x, kPavement - 0.003, z}); };
      for (int k = 0; k < 2; ++k) {
        scene_.place(lamp, at(-17.5 + 14 * k + 3 * side, kRoad + 0.45) * turned(0.5));
        const glm::dmat4 seat =
            at(-15.2 + 12 * k - 2 * side, kRoad + 0.75) * turned(k % 2 == 0 ? 0 : 0.5);
        if (k == 0 || side < 0) {
          scene_.place(slats, seat);
          scene_.place(irons, seat);
          scene_.place(basket, seat * moved({1.35, 0, 0}));
        }
      }
      for (int k = 0; k < 5; ++k) scene_.place(post, at(-16.9 + 1.5 * k + 3 * side, kRoad + 0.4));
    }
    scene_.place(stand, moved({3.5, kPavement - 0.003, kRoad + 0.9}));
  }

  // An awning over each window of a shop, with its frame.
  void addAwnings(const House& shop, const glm::dmat4& place, uint32_t cloth) {
    if (shop.shopWindows.empty()) return;
    const double half = shop.shopWidth / 2 + 0.1, reach = 1.3, drop = 0.66;
    const uint32_t sheet = scene_.add(awning(2 * half + 0.06, reach, drop), cloth, kNoCrease);
    Solid arms;
    const auto rod = [&](const glm::dvec3& from, const glm::dvec3& to, double radius) {
      append(arms, tube({from, to}, radius, 6));
    };
    for (const double x : {-half, half}) {
      rod({x, -drop - 0.02, -0.3}, {x, -drop - 0.025, reach - 0.01}, 0.014);
      rod({x, -drop - 0.02, 0.4}, {x, -0.06, -0.3}, 0.01);
    }
    rod({-half - 0.05, -drop - 0.025, reach - 0.01}, {half + 0.05, -drop - 0.025, reach - 0.01},
        0.014);
    rod({-half - 0.08, -0.03, -0.01}, {half + 0.08, -0.03, -0.01}, 0.035);
    const uint32_t frame = scene_.add(arms, iron_, kCrease60);
    for (const double x : shop.shopWindows) {
      const glm::dmat4 hung = place * moved({x, 2.88, 0.14});
      scene_.place(sheet, hung);
      scene_.place(frame, hung);
    }
  }

  void addCables() {
    Solid wires, lamps, flags;
    const auto across = [&](double x, double slant, double y, double sag) {
      return hanging({x, y, -kHouseFront - 0.1}, {x + slant, y + 0.2, kHouseFront + 0.1}, sag, 18);
    };
    for (const double x : {-13.0, -3.5, 7.0}) {
      const Path wire = across(x, 0.6, 7.2, 0.55);
      append(wires, tube(wire, 0.012, 5));
      const glm::dvec3 middle = wire[9];
      append(wires, tube({middle, middle - glm::dvec3(0, 0.35, 0)}, 0.01, 6));
      append(
          lamps,
          lathe(std::array{glm::dvec2(0.05, -0.28), glm::dvec2(0.16, -0.36), glm::dvec2(0.3, -0.5),
                           glm::dvec2(0.3, -0.53), glm::dvec2(0.27, -0.53), glm::dvec2(0.14, -0.4)},
                18),
          moved(middle));
    }
    for (const double x : {-17.2, -8.3}) {
      const Path wire = across(x, 1.6, 5.3, 0.7);
      append(wires, tube(wire, 0.006, 5));
      for (size_t k = 1; k + 1 < wire.size(); ++k) {
        const glm::dvec3 along = glm::normalize(wire[k + 1] - wire[k]);
        const glm::dvec3 blown(0.07 * hashBetween(static_cast<uint32_t>(k), -1, 1), -0.3, 0);
        append(flags, sheet(2, 2, [&](double u, double v) {
                 const double width = 0.2 * (1 - 0.92 * v);
                 return wire[k] - glm::dvec3(0, 0.004, 0) + (u - 0.5) * width * along + v * blown +
                        0.03 * sinTurns(u + v) * glm::dvec3(v, 0, 0);
               }));
      }
    }
    scene_.put(wires, rubber_, kCrease75);
    scene_.put(lamps, iron_, kCrease60);
    scene_.put(flags, red_, kNoCrease);
  }

  Assembly scene_{"street"};
  uint32_t asphalt_ = scene_.plain("asphalt", {0.17f, 0.17f, 0.18f});
  uint32_t stone_ = scene_.plain("stone", {0.47f, 0.46f, 0.44f});
  uint32_t plaster_[4] = {scene_.plain("ochre plaster", {0.66f, 0.53f, 0.33f}),
                          scene_.plain("grey plaster", {0.6f, 0.6f, 0.57f}),
                          scene_.plain("rose plaster", {0.66f, 0.46f, 0.4f}),
                          scene_.plain("brick", {0.45f, 0.25f, 0.18f})};
  uint32_t trim_ = scene_.plain("dressed stone", {0.7f, 0.68f, 0.62f});
  uint32_t tiles_ = scene_.plain("roof tiles", {0.42f, 0.2f, 0.14f});
  uint32_t glass_ = scene_.plain("dark glass", {0.07f, 0.09f, 0.11f});
  uint32_t iron_ = scene_.plain("iron", {0.13f, 0.14f, 0.14f});
  uint32_t green_ = scene_.plain("green wood", {0.12f, 0.25f, 0.17f});
  uint32_t wood_ = scene_.plain("wood", {0.42f, 0.28f, 0.16f});
  uint32_t rubber_ = scene_.plain("rubber", {0.04f, 0.04f, 0.045f});
  uint32_t red_ = scene_.cloth("red cloth", {0.5f, 0.08f, 0.07f});
  uint32_t sand_ = scene_.cloth("sand cloth", {0.7f, 0.6f, 0.4f});
};

}  // namespace

Scene makeStreet() {
  return Street().build();
}

}  // namespace grisaille::scene
