// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include "core/scene/built_in/street_parts.h"

namespace grisaille::scene {
namespace {

constexpr double kGroundFloor = 3.7, kRecess = 0.24;

struct Opening {
  double x, low, width, height;
  bool door;
};

class Builder {
 public:
  Builder(const HouseForm& form, uint32_t seed) : form_(form), seed_(seed) {}

  House build() {
    house_.height = kGroundFloor + form_.storeys * form_.storey;
    addGroundFloor();
    addUpperFloors();
    addMouldings();
    addRoof();
    addDrainPipe();
    return std::move(house_);
  }

 private:
  double random(uint32_t salt, double low, double high) const {
    return hashBetween(seed_ * 256 + salt, low, high);
  }

  // A wall with one row of openings, or several rows of equal ones.
  void addWall(const std::vector<Opening>& openings, double low, double high, uint32_t rows,
               double shrink, double forward) {
    std::vector<double> xs{-form_.width / 2 + shrink};
    for (const Opening& o : openings) {
      xs.push_back(o.x - o.width / 2);
      xs.push_back(o.x + o.width / 2);
    }
    xs.push_back(form_.width / 2 - shrink);
    std::vector<double> ys{low};
    for (uint32_t j = 0; j < rows; ++j) {
      ys.push_back(openings[0].low + j * form_.storey);
      ys.push_back(ys.back() + openings[0].height);
    }
    ys.push_back(high);
    append(
        house_.walls,
        recessedWall(
            xs, ys, [](uint32_t i, uint32_t j) { return i % 2 == 1 && j % 2 == 1 ? kRecess : 0; },
            form_.depth - shrink),
        moved({0, 0, forward}));
  }

  void addGroundFloor() {
    // Openings share their sill and lintel; doors and shops have a base below the sill filled in.
    const uint32_t count = form_.shop ? 3 : form_.windows;
    std::vector<Opening> openings;
    const double pitch = form_.width / count;
    for (uint32_t i = 0; i < count; ++i) {
      const bool door = i == (seed_ % count);
      const double width = door ? 1.15 : form_.shop ? 0.74 * pitch : 1.15;
      openings.push_back({(i + 0.5) * pitch - form_.width / 2, 0.16, width, 2.65, door});
    }
    addWall(openings, -0.6, kGroundFloor + 0.06, 1, 0, 0);
    for (const Opening& o : openings) {
      if (o.door) {
        addDoor(o);
      } else if (form_.shop) {
        addShopWindow(o);
      } else {
        // The parapet under the window.
        append(house_.walls, box({o.x - o.width / 2 - 0.05, 0.1, -kRecess - 0.05},
                                 {o.x + o.width / 2 + 0.05, 0.95, -0.03}));
        addWindow({o.x, 0.95, o.width, 1.86, false}, 0);
      }
    }
  }

  void addUpperFloors() {
    std::vector<Opening> openings;
    const double pitch = form_.width / form_.windows;
    for (uint32_t i = 0; i < form_.windows; ++i) {
      openings.push_back({(i + 0.5) * pitch - form_.width / 2, kGroundFloor + 0.75, 1.12,
                          form_.storey - 1.25, false});
    }
    addWall(openings, kGroundFloor, house_.height, form_.storeys, 0.012, -0.045);
    for (uint32_t j = 0; j < form_.storeys; ++j) {
      for (uint32_t i = 0; i < form_.windows; ++i) {
        Opening o = openings[i];
        o.low += j * form_.storey;
        addWindow(o, -0.045);
        const uint32_t salt = j * 16 + i;
        if (form_.balconies && j + 1 < form_.storeys && i % 2 == 1) {
          addBalcony(o);
        } else if (hashUnit(seed_ * 64 + salt) < 0.3) {
          addShutters(o);
        }
      }
    }
  }

  void addWindow(const Opening& o, double forward) {
    const double l = o.x - o.width / 2, r = o.x + o.width / 2, top = o.low + o.height;
    const double back = forward - kRecess;
    append(house_.glass,
           box({l - 0.02, o.low - 0.02, back - 0.02}, {r + 0.02, top + 0.02, back + 0.03}));
    const auto bar = [&](const glm::dvec2& low, const glm::dvec2& high, double out) {
      append(house_.trim, box({low.x, low.y, back - 0.01}, {high.x, high.y, back + out}));
    };
    // The frame, set into the recess by a centimetre.
    const std::array edge{glm::dvec2(-0.01, -0.01), glm::dvec2(0.07, -0.01), glm::dvec2(0.07, 0.08),
                          glm::dvec2(-0.01, 0.08)};
    append(house_.trim, frame(edge, {o.width / 2, o.height / 2}),
           moved({o.x, o.low + o.height / 2, back}) * turnedX(0.25));
    bar({o.x - 0.035, o.low}, {o.x + 0.035, top}, 0.075);
    bar({l, o.low + 0.64 * o.height}, {r, o.low + 0.64 * o.height + 0.05}, 0.07);
    append(house_.trim, box({l - 0.1, o.low - 0.1, forward - 0.1},
                            {r + 0.1, o.low + 0.03, forward + 0.09}, 0.015));
    append(house_.trim,
           box({l - 0.14, top - 0.005, forward - 0.1}, {r + 0.14, top + 0.17, forward + 0.05}));
    append(house_.trim, box({l - 0.18, top + 0.15, forward - 0.1},
                            {r + 0.18, top + 0.23, forward + 0.11}, 0.015));
  }

  void addShutters(const Opening& o) {
    for (const double side : {-1.0, 1.0}) {
      const double x = o.x + side * (o.width / 2 + 0.31);
      append(house_.metal,
             box({x - 0.27, o.low + 0.05, -0.09}, {x + 0.27, o.low + o.height - 0.02, 0.0}));
      for (int k = 0; k < 5; ++k) {
        const double y = o.low + 0.16 + (o.height - 0.34) * k / 4;
        append(house_.metal, box({x - 0.22, y - 0.1, -0.02}, {x + 0.22, y + 0.01, 0.014}));
      }
    }
  }

  void addBalcony(const Opening& o) {
    const double l = o.x - 0.95, r = o.x + 0.95, y = o.low - 0.1, out = 0.72;
    append(house_.trim, box({l, y - 0.15, -0.2}, {r, y, out}, 0.02));
    for (const double x : {l + 0.2, r - 0.2}) {
      std::vector<Ring> sides;
      for (const double at : {x - 0.07, x + 0.07}) {
        sides.push_back({{at, y - 0.14, -0.2},
                         {at, y - 0.14, 0.55},
                         {at, y - 0.24, 0.5},
                         {at, y - 0.42, 0.1},
                         {at, y - 0.6, -0.2}});
      }
      append(house_.trim, loft(sides, false));
    }
    const auto rod = [&](const glm::dvec3& from, const glm::dvec3& to, double radius) {
      append(house_.metal, tube({from, to}, radius, 4));
    };
    const double top = y + 0.95, edge = out - 0.06;
    for (const double height : {y + 0.1, top}) {
      append(house_.metal, tube(bent(Path{{l + 0.06, height, -0.1},
                                          {l + 0.06, height, edge},
                                          {r - 0.06, height, edge},
                                          {r - 0.06, height, -0.1}},
                                     0.06, 1),
                                height > y + 0.5 ? 0.024 : 0.014, 5));
    }
    for (int k = 1; k < 12; ++k) {
      const double x = l + 0.06 + (r - l - 0.12) * k / 12;
      rod({x, y - 0.02, edge}, {x, top, edge}, 0.009);
    }
    for (int k = 0; k < 4; ++k) {
      const double z = 0.08 + 0.14 * k;
      for (const double x : {l + 0.06, r - 0.06}) rod({x, y - 0.02, z}, {x, top, z}, 0.009);
    }
  }

  void addDoor(const Opening& o) {
    const double l = o.x - o.width / 2, r = o.x + o.width / 2, top = o.low + o.height;
    const double back = -kRecess;
    append(house_.metal,
           box({l - 0.02, o.low - 0.05, back - 0.02}, {r + 0.02, top + 0.02, back + 0.04}));
    for (int k = 0; k < 2; ++k) {
      for (int row = 0; row < 2; ++row) {
        const double x = l + 0.12 + 0.49 * k, y = o.low + 0.15 + 0.85 * row;
        append(house_.metal, box({x, y, back + 0.02}, {x + 0.4, y + 0.7, back + 0.065}, 0.02));
      }
    }
    append(house_.glass, box({l + 0.1, o.low + 2.05, back}, {r - 0.1, top - 0.1, back + 0.06}));
    append(house_.metal, ball(0.035, 8, 5), moved({o.x + 0.05, o.low + 1.0, back + 0.09}));
    for (const double side : {-1.0, 1.0}) {
      const double x = o.x + side * (o.width / 2 + 0.12);
      append(house_.trim, box({x - 0.13, -0.2, -0.1}, {x + 0.13, top + 0.01, 0.07}, 0.015));
      append(house_.trim, box({x - 0.16, -0.2, -0.1}, {x + 0.16, 0.42, 0.1}, 0.02));
    }
    append(house_.trim, box({l - 0.3, top, -0.1}, {r + 0.3, top + 0.2, 0.12}, 0.02));
    append(house_.trim, box({l - 0.36, top + 0.17, -0.1}, {r + 0.36, top + 0.26, 0.2}, 0.025));
    // Two steps.
    append(house_.trim, box({l - 0.3, -0.4, -0.2}, {r + 0.3, 0.17, 0.36}, 0.02));
    append(house_.trim, box({l - 0.42, -0.4, -0.2}, {r + 0.42, 0.01, 0.72}, 0.02));
  }

  void addShopWindow(const Opening& o) {
    house_.shopWindows.push_back(o.x);
    house_.shopWidth = o.width;
    const double l = o.x - o.width / 2, r = o.x + o.width / 2, top = o.low + o.height;
    const double back = -kRecess;
    append(house_.glass,
           box({l - 0.02, o.low + 0.3, back - 0.02}, {r + 0.02, top + 0.02, back + 0.05}));
    append(house_.metal,
           box({l - 0.02, o.low - 0.1, back - 0.02}, {r + 0.02, o.low + 0.45, back + 0.14}));
    append(house_.metal,
           box({l - 0.01, top - 0.1, back - 0.02}, {r + 0.01, top + 0.03, back + 0.1}));
    const int panes = 3;
    for (int k = 0; k <= panes; ++k) {
      const double x = l + (r - l) * k / panes;
      append(house_.metal,
             box({x - 0.035, o.low + 0.4, back - 0.01}, {x + 0.035, top - 0.05, back + 0.09}));
    }
    append(house_.metal, block({l - 0.2, top + 0.06, -0.1}, {r + 0.2, top + 0.58, 0.09}, 0.02));
  }

  void addMouldings() {
    const double half = form_.width / 2;
    const auto moulding = [&](std::span<const glm::dvec2> profile, double y, double past) {
      append(house_.trim, sweep(profile, {{-half - past, y, 0}, {half + past, y, 0}}, {0, 1, 0}));
    };
    // Sections are (towards +z, up): the sweep runs along +x.
    constexpr glm::dvec2 kBand[] = {{-0.2, 0},   {0.06, 0},    {0.07, 0.05}, {0.12, 0.1},
                                    {0.12, 0.2}, {0.07, 0.24}, {-0.2, 0.24}};
    constexpr glm::dvec2 kCornice[] = {{-0.3, -0.3}, {0.02, -0.3}, {0.06, -0.26}, {0.06, -0.1},
                                       {0.16, 0.0},  {0.3, 0.08},  {0.42, 0.12},  {0.42, 0.3},
                                       {0.36, 0.36}, {-0.3, 0.36}};
    moulding(kBand, kGroundFloor - 0.1, 0.004);
    moulding(kCornice, house_.height - 0.1, 0.006);
    const auto brackets = static_cast<int>(form_.width / 1.05);
    for (int k = 0; k <= brackets; ++k) {
      const double x = -half + 0.15 + (form_.width - 0.3) * k / brackets;
      append(house_.trim,
             box({x - 0.07, house_.height - 0.22, -0.1}, {x + 0.07, house_.height + 0.01, 0.27}));
    }
    append(house_.trim, box({-half - 0.003, -0.5, -0.2}, {half + 0.003, 0.1, 0.05}, 0.02));
  }

  void addRoof() {
    const double half = form_.width / 2, y = house_.height;
    if (!form_.pitched) {
      append(house_.walls,
             frame(std::array{glm::dvec2(0, -0.1), glm::dvec2(0.22, -0.1), glm::dvec2(0.22, 0.85),
                              glm::dvec2(0, 0.85)},
                   {half - 0.02, form_.depth / 2 - 0.05}),
             moved({0, y, -form_.depth / 2 - 0.1}));
      append(house_.trim,
             frame(std::array{glm::dvec2(-0.05, 0.84), glm::dvec2(0.28, 0.84),
                              glm::dvec2(0.28, 0.93), glm::dvec2(-0.05, 0.93)},
                   {half - 0.03, form_.depth / 2 - 0.06}),
             moved({0, y, -form_.depth / 2 - 0.1}));
      append(house_.metal, block({-1, y - 0.1, -4.5}, {0.6, y + 1.4, -3.2}, 0.05));
    } else {
      const double rise = 0.36 * form_.depth;
      std::vector<Ring> ends;
      for (const double x : {-half + 0.02, half - 0.02}) {
        ends.push_back({{x, y - 0.2, 0.3},
                        {x, y + 0.22, 0.3},
                        {x, y + rise, -form_.depth / 2},
                        {x, y + 0.22, -form_.depth - 0.3},
                        {x, y - 0.2, -form_.depth - 0.3}});
      }
      append(house_.roof, loft(ends, false));
      // Dormers.
      for (uint32_t k = 0; k + 1 < form_.windows; ++k) {
        const double x = (k + 1) * form_.width / form_.windows - half;
        append(house_.walls, box({x - 0.6, y, -2.6}, {x + 0.6, y + 1.56, -0.55}));
        append(house_.glass, box({x - 0.42, y + 0.62, -0.7}, {x + 0.42, y + 1.5, -0.53}));
        append(house_.trim, box({x - 0.03, y + 0.6, -0.7}, {x + 0.03, y + 1.5, -0.51}));
        append(house_.roof, loft(std::array<Ring, 2>{Ring{{x - 0.75, y + 1.5, -0.35},
                                                          {x + 0.75, y + 1.5, -0.35},
                                                          {x, y + 2.05, -0.35}},
                                                     Ring{{x - 0.75, y + 1.5, -3.4},
                                                          {x + 0.75, y + 1.5, -3.4},
                                                          {x, y + 2.05, -3.4}}},
                                 false));
      }
    }
    for (uint32_t k = 0; k < 2; ++k) {
      const double x = (k == 0 ? -1 : 1) * (half - 0.9) + random(80 + k, -0.2, 0.2),
                   z = -form_.depth * 0.55;
      const double top =
          y + (form_.pitched ? 0.36 * form_.depth + 0.8 : 2.0) + random(90 + k, 0, 0.4);
      append(house_.walls, box({x - 0.45, y - 0.1, z - 0.3}, {x + 0.45, top, z + 0.3}));
      append(house_.trim,
             block({x - 0.52, top - 0.04, z - 0.37}, {x + 0.52, top + 0.12, z + 0.37}, 0.03));
      for (const double pot : {-0.22, 0.2}) {
        append(house_.roof,
               lathe(std::array{glm::dvec2(0.13, top), glm::dvec2(0.1, top + 0.52),
                                glm::dvec2(0.13, top + 0.6), glm::dvec2(0.09, top + 0.6),
                                glm::dvec2(0.08, top + 0.3)},
                     8),
               moved({x + pot, 0, z}));
      }
    }
  }

  void addDrainPipe() {
    const double x = form_.width / 2 - 0.25, y = house_.height;
    append(house_.metal, tube(bent(Path{{x, y - 0.35, 0.3},
                                        {x, y - 0.6, 0.3},
                                        {x, y - 1.0, 0.1},
                                        {x, 0.35, 0.1},
                                        {x, 0.1, 0.2}},
                                   0.12, 1),
                              0.045, 6));
    const auto clips = static_cast<int>((y - 2.5) / 2.6) + 1;
    for (int k = 0; k < clips; ++k) {
      const double at = 1.2 + 2.6 * k;
      append(house_.metal,
             lathe(std::array{glm::dvec2(0.058, at), glm::dvec2(0.058, at + 0.06)}, 8),
             moved({x, 0, 0.1}));
    }
  }

  HouseForm form_;
  uint32_t seed_;
  House house_;
};

}  // namespace

House house(const HouseForm& form, uint32_t seed) {
  return Builder(form, seed).build();
}

}  // namespace grisaille::scene
