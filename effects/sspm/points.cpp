// SPDX-License-Identifier: MIT
#include "points.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "threads.h"

namespace grisaille::sspm {
namespace {

constexpr size_t kChunk = 1 << 16;  // points in work at the same time
constexpr size_t kBlock = 256;      // points that a thread takes at a time
// Shots that a point asks rays for in a round: twice as many in each, as most need few.
constexpr size_t kFirstRound = 1, kMostRound = 32;
// How far before the point a ray ends: a share of the range, for surfaces that touch, and of the
// distance, for the rounding of the ray's direction.
constexpr double kEndRange = 1e-3, kEndDistance = 2e-6;
constexpr float kFill = 4;  // how steeply the strengths of several shots close gaps: splat.glsl

glm::dvec3 originOf(const Shot& shot) {
  return {shot.origin[0], shot.origin[1], shot.origin[2]};
}

glm::dvec3 positionOf(const grisaille_point& point) {
  return {point.position[0], point.position[1], point.position[2]};
}

glm::vec3 normalOf(const grisaille_point& point) {
  return {point.normal[0], point.normal[1], point.normal[2]};
}

// Offset of a point from the shot's ray, along the axes of its frame, metres. False if the shot
// does not reach the point. q: its offset from the muzzle.
bool acrossOf(const Shot& shot, float range, const glm::dvec3& q, glm::dvec2& across) {
  const glm::dvec3 w(shot.direction[0], shot.direction[1], shot.direction[2]);
  if (glm::dot(q, w) < 0) return false;
  const ShotFrame frame(shot, range);
  across = {glm::dot(q, glm::dvec3(frame.right)), glm::dot(q, glm::dvec3(frame.up))};
  return glm::length(across) < double{range};
}

// What lies on a point, composited newest first: steps 2 to 5 of the definition, as in
// shaders/sspm/splat.glsl.
struct Sum {
  glm::vec3 colour = glm::vec3(0);  // of the shots, times the alpha that each adds
  float alpha = 0;                  // largest of the shots' alphas
  float strengths = 0;              // sum
  float weight = 0;                 // alpha that the owner adds
  uint64_t owner = 0;

  bool isOpen() const { return strengths < 1 && alpha < 1; }

  // number: 1 + the shot's index.
  void add(const Shot& shot, uint64_t number, const glm::dvec2& across, float times,
           const PaintRules& rules, const Splat& splat) {
    const auto apart = static_cast<float>(glm::length(across));
    const float range = shot.rangeOr(rules.range);
    const float strength = rules.strength(apart, range, times);
    strengths += strength;
    const float filled = glm::clamp(1 - kFill * (1 - strengths), strength, 1.0f);
    const bool certain = filled >= 0.9f + splat.halfWidth;  // whatever the noise is
    const double middle = double{range} * (1 - 0.5 * double{rules.fade});
    const float noise = certain ? 0 : splat.noiseAt(splatSeed(shot, splat.seed), across, middle);
    const float shown = splat.alphaOf(filled, noise);
    const float adds = std::max(shown - alpha, 0.0f);
    colour += adds * glm::vec3(shot.color[0], shot.color[1], shot.color[2]);
    alpha = std::max(alpha, shown);
    if (adds <= weight) return;
    weight = adds;
    owner = number;
  }

  grisaille_drawn drawn() const {
    if (alpha <= 0) return {};
    const glm::vec3 c = glm::min(colour / alpha, 1.0f);
    return {.colour = {c.x, c.y, c.z}, .alpha = std::min(alpha, 1.0f), .owner = owner};
  }
};

// Composites one chunk of points in rounds: each asks for the next shots of the points that are
// still open, casts their rays in one batch, and composites those whose muzzle sees the point.
class Chunk {
 public:
  Chunk(const PaintWorld& world, std::span<const Shot> shots, const PaintRules& rules,
        const Splat& splat, std::span<const grisaille_point> points)
      : world_(world), shots_(shots), rules_(rules), splat_(splat), points_(points) {
    blocks_.resize((points.size() + kBlock - 1) / kBlock);
    onAllThreads(blocks_.size(), [&](size_t b) {
      Block& block = blocks_[b];
      const size_t first = b * kBlock;
      for (size_t i = first; i < std::min(first + kBlock, points.size()); ++i) {
        block.open.push_back({.point = i});
      }
    });
  }

  // False if the host casts no rays.
  bool draw(const CastRays& cast, std::span<grisaille_drawn> drawn) {
    for (size_t most = kFirstRound; ask(most); most = std::min(2 * most, kMostRound)) {
      writeRays();
      hits_.assign(rays_.size(), {});
      if (!rays_.empty() && !cast(rays_, hits_)) return false;
      composite(most, drawn);
    }
    return true;
  }

 private:
  struct Open {
    size_t point;
    Sum sum = {};
    uint32_t below = ~0u;  // the shots from this one on are done
    size_t asked = 0;      // shots of this round
  };
  struct Block {
    std::vector<Open> open;
    std::vector<PaintWorld::Reach> reaches;  // of all open points, in their order
    size_t first = 0;                        // ray of the first one
  };

  // Finds the next shots of all open points. False: none is open.
  bool ask(size_t most) {
    onAllThreads(blocks_.size(), [&](size_t b) {
      Block& block = blocks_[b];
      block.reaches.clear();
      for (Open& open : block.open) {
        const size_t before = block.reaches.size();
        const grisaille_point& point = points_[open.point];
        world_.reachesOf(positionOf(point), normalOf(point), open.below, most, block.reaches);
        open.asked = block.reaches.size() - before;
      }
    });
    size_t count = 0;
    for (Block& block : blocks_) {
      block.first = count;
      count += block.reaches.size();
    }
    rays_.resize(count);
    order_.resize(count);
    return std::ranges::any_of(blocks_, [](const Block& block) { return !block.open.empty(); });
  }

  // Rays from one muzzle lie side by side, which makes them coherent.
  void writeRays() {
    std::vector<uint64_t> keys(rays_.size());  // shot, then index
    onAllThreads(blocks_.size(), [&](size_t b) {
      const Block& block = blocks_[b];
      for (size_t i = 0; i < block.reaches.size(); ++i) {
        keys[block.first + i] = uint64_t{block.reaches[i].shot} << 32 | (block.first + i);
      }
    });
    std::ranges::sort(keys);
    for (size_t i = 0; i < keys.size(); ++i) order_[keys[i] & ~0u] = static_cast<uint32_t>(i);
    onAllThreads(blocks_.size(), [&](size_t b) {
      const Block& block = blocks_[b];
      size_t at = 0;
      for (const Open& open : block.open) {
        const glm::dvec3 position = positionOf(points_[open.point]);
        for (size_t end = at + open.asked; at < end; ++at) {
          rays_[order_[block.first + at]] = rayTo(position, shots_[block.reaches[at].shot]);
        }
      }
    });
  }

  grisaille_ray rayTo(const glm::dvec3& position, const Shot& shot) const {
    const glm::dvec3 origin = originOf(shot);
    const double distance = glm::length(position - origin);
    const glm::vec3 unit((position - origin) / std::max(distance, 1e-30));
    const double end = kEndRange * double{shot.rangeOr(rules_.range)} + kEndDistance * distance;
    return {.origin = {origin.x, origin.y, origin.z},
            .direction = {unit.x, unit.y, unit.z},
            .reach = static_cast<float>(std::max(distance - end, 1e-30))};
  }

  void composite(size_t most, std::span<grisaille_drawn> drawn) {
    onAllThreads(blocks_.size(), [&](size_t b) {
      Block& block = blocks_[b];
      size_t at = 0;
      for (Open& open : block.open) {
        for (size_t end = at + open.asked; at < end; ++at) {
          const PaintWorld::Reach& reach = block.reaches[at];
          open.below = reach.shot;
          const grisaille_ray& ray = rays_[order_[block.first + at]];
          const grisaille_hit& hit = hits_[order_[block.first + at]];
          const bool seen = hit.kind == GRISAILLE_HIT_NONE ||
                            (hit.kind == GRISAILLE_HIT_SURFACE && hit.distance >= ray.reach);
          if (!seen || !open.sum.isOpen()) continue;
          open.sum.add(shots_[reach.shot], uint64_t{reach.shot} + 1, reach.across, reach.times,
                       rules_, splat_);
        }
      }
      std::erase_if(block.open, [&](const Open& open) {
        if (open.asked == most && open.sum.isOpen()) return false;
        drawn[open.point] = open.sum.drawn();
        return true;
      });
    });
  }

  const PaintWorld& world_;
  std::span<const Shot> shots_;
  const PaintRules& rules_;
  const Splat& splat_;
  std::span<const grisaille_point> points_;
  std::vector<Block> blocks_;
  std::vector<grisaille_ray> rays_;
  std::vector<grisaille_hit> hits_;
  std::vector<uint32_t> order_;  // place of each reach's ray in rays_
};

}  // namespace

bool PaintWorld::reach(const glm::dvec3& position, const glm::vec3& normal, const Entry& entry,
                       Reach& reach) const {
  const Shot& shot = list_[reach.shot];
  const glm::dvec3 q = position - originOf(shot);
  if (glm::dot(q, glm::dvec3(normal)) >= 0) return false;
  const uint32_t record = recordOf(entry);
  if (record == kNone || placed_[record].hidden) return false;
  reach.times += static_cast<float>(placed_[record].counted);
  return acrossOf(shot, rangeOf(reach.shot), q, reach.across);
}

void PaintWorld::reachesOf(const glm::dvec3& position, const glm::vec3& normal, uint32_t below,
                           size_t most, std::vector<Reach>& reaches) const {
  struct List {
    const Entry* at;
    const Entry* end;
    uint64_t part;
  };
  List lists[kMostLevels];
  size_t count = 0;
  for (const int32_t level : levels_) {
    const glm::dvec3 place = position / edgeOf(level);
    const glm::dvec3 whole = glm::floor(glm::clamp(place, -1e9, 1e9));
    const glm::ivec3 in(glm::clamp((place - whole) * 4.0, 0.0, 3.0));
    const Cell* cell = cells_.find({glm::ivec3(whole), level + facingOf(normal)});
    if (cell == nullptr) continue;
    const Entry* at = std::lower_bound(cell->entries.begin(), cell->entries.end(), below,
                                       [](const Entry& e, uint32_t id) { return e.shot >= id; });
    if (at == cell->entries.end()) continue;
    lists[count++] = {at, cell->entries.end(), uint64_t{1} << (in.x | in.y << 2 | in.z << 4)};
  }
  for (size_t found = 0; count > 0 && found < most;) {
    List* newest = std::max_element(
        lists, lists + count, [](const List& a, const List& b) { return a.at->shot < b.at->shot; });
    Reach next{.shot = newest->at->shot};
    if ((newest->at->touched & newest->part) != 0 && reach(position, normal, *newest->at, next)) {
      reaches.push_back(next);
      ++found;
    }
    if (++newest->at == newest->end) *newest = lists[--count];
  }
}

void drawPoints(const PaintWorld& world, std::span<const Shot> shots, const PaintRules& rules,
                const Splat& splat, const CastRays& cast, std::span<const grisaille_point> points,
                std::span<grisaille_drawn> drawn) {
  for (size_t first = 0; first < points.size(); first += kChunk) {
    const size_t count = std::min(kChunk, points.size() - first);
    Chunk chunk(world, shots, rules, splat, points.subspan(first, count));
    if (!chunk.draw(cast, drawn.subspan(first, count))) return;
  }
}

void drawPointsPerShot(std::span<const Shot> shots, size_t count, const PaintRules& rules,
                       const Splat& splat, std::span<const grisaille_point> points,
                       std::span<grisaille_drawn> drawn) {
  const std::vector<Layer> layers = layersOf(shots, count);
  onAllThreads((points.size() + kBlock - 1) / kBlock, [&](size_t b) {
    for (size_t i = b * kBlock; i < std::min((b + 1) * kBlock, points.size()); ++i) {
      Sum sum;
      for (size_t l = 0; l < layers.size() && sum.isOpen(); ++l) {
        const Shot& shot = shots[layers[l].shot];
        const glm::dvec3 q = positionOf(points[i]) - originOf(shot);
        glm::dvec2 across;
        if (!acrossOf(shot, shot.rangeOr(rules.range), q, across)) continue;
        sum.add(shot, layers[l].shot + 1, across, layers[l].times, rules, splat);
      }
      drawn[i] = sum.drawn();
    }
  });
}

}  // namespace grisaille::sspm
