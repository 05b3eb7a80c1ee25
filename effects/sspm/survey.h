// SPDX-License-Identifier: MIT
// Finds out what a shot's muzzle sees, by rays: says which to cast next, takes the hits, and so on
// until it knows. First the farthest surface and a rough picture, then, if asked to go on, the map.
// `./dev bench sspm` prints the rays a shot.
#pragma once

#include <cmath>
#include <span>
#include <unordered_map>
#include <vector>

#include "shot_map.h"

namespace grisaille::sspm {

// A piece of a seen surface, as corners from the muzzle, cut where they leave the cylinder.
struct Patch {
  glm::vec3 corners[4];
  glm::vec3 centre;
  glm::vec4 plane;      // normal towards the muzzle; its product with offsets on the surface
  bool ragged = false;  // it hides something beside it, or something hides it
  bool whole = true;    // not cut
  // Of one of several planes that share a square: it may be anywhere in it, and is at these.
  std::vector<glm::vec3> seen = {};
};

// Whether one plane serves a place on another too. `bias` of the shot's frame.
inline bool serves(const glm::vec4& plane, const glm::vec3& at, const glm::vec4& other,
                   float bias) {
  return std::abs(glm::dot(glm::vec3(plane), at) - plane.w) <= 0.25f * bias &&
         glm::dot(glm::vec3(plane), glm::vec3(other)) > 0.98f;
}

class Survey {
 public:
  // `range` in metres, over 0.
  Survey(const Shot& shot, float range);

  // To be cast next, and their hits to be taken. None: the rough picture or the map is done.
  std::span<const grisaille_ray> rays() const { return rays_; }
  // False where the host cannot tell now how far the shot goes: it is to be surveyed anew later.
  bool take(std::span<const grisaille_hit> hits);

  // Goes on from the rough picture to the map.
  void refine();
  bool isRough() const { return stage_ != Stage::kFine; }

  // Squares of which the host could not tell, of all and of those within a range of the axis. The
  // map has no paint there.
  size_t unknown() const { return countUnknown(1e30f); }
  size_t unknownInside() const { return countUnknown(1); }
  // Asks for them again, once the map is done.
  void askAgain();

  // What is seen within range, when there are no rays to cast.
  std::vector<Patch> patches() const;
  const ShotFrame& frame() const { return frame_; }
  // After refine(), when there are no rays to cast.
  ShotMap map();

 private:
  enum class Stage : uint8_t { kProbing, kRough, kFine };
  struct Sample {
    bool hit = false;
    bool unknown = false;            // `hit` too, by a plane that nothing lies before
    glm::vec4 plane = glm::vec4(0);  // normal, product
    glm::vec3 at = glm::vec3(0);     // offset of the hit
  };
  // A square of the map while it is made.
  struct Square {
    glm::vec2 centre = glm::vec2(0);
    float size = 0;
    int32_t children = -1;  // index of the first of 16
    // Of an open square: one that sees a surface which ends between them, or which leaves the
    // cylinder there.
    int32_t beside = -1, rim = -1;
    glm::ivec2 corner = glm::ivec2(0);  // the lower one, in the finest squares from the map's own
    Sample sample = {};
    bool edge = false;    // another surface is seen beside it
    bool ragged = false;  // and not one that meets it there
  };
  // Sizes of undivided squares within a unit of the centre, within three, and beyond.
  struct Grain {
    float inner, middle, outer;
  };

  Square& at(int32_t index) { return squares_[static_cast<size_t>(index)]; }
  const Square& at(int32_t index) const { return squares_[static_cast<size_t>(index)]; }

  void probe(float farthest);
  bool probed();
  size_t countUnknown(float within) const;
  void ask();
  void lay(int32_t index, const Grain& grain);
  void addChildren(int32_t parent);
  void gatherLeaves(int32_t index, std::vector<int32_t>& leaves) const;
  bool inRange(const Sample& sample) const;
  int32_t leafAt(glm::ivec2 place) const;
  bool planePastExit(const Square& open, const glm::vec4& plane) const;
  bool agree(const Square& a, const Square& b) const;
  bool meet(const Sample& a, const Sample& b) const;
  std::vector<int32_t> findEdges(const std::vector<int32_t>& among);
  const Square& seenBy(const Square& square) const;
  bool isFine(const Square& square) const;

  struct SeenPlane {
    const Sample* sample;
    std::vector<glm::vec3> seen;
  };
  void gatherPatches(int32_t index, std::vector<Patch>& patches) const;
  bool gatherPlanes(int32_t index, std::vector<SeenPlane>& planes) const;
  Patch patchOf(const Square& square, const glm::vec4& plane) const;
  bool serves(int32_t index, const Square*& leaf, bool smooth) const;
  bool uniform(int32_t index, const Square*& leaf, bool smooth) const;
  uint32_t write(int32_t index, ShotMap& map);
  uint32_t planeWord(const glm::vec4& plane, ShotMap& map);

  ShotFrame frame_;
  Stage stage_ = Stage::kProbing;
  float farthest_ = 0;
  int probes_ = 0;     // rounds of them
  bool anew_ = false;  // all edges are to be found anew
  std::vector<Square> squares_;
  std::vector<int32_t> asked_;  // squares that rays_ are of
  std::vector<grisaille_ray> rays_;
  std::unordered_map<uint64_t, uint32_t> planes_;
};

}  // namespace grisaille::sspm
