// SPDX-License-Identifier: MIT
// Surveys by ray casts what a shot's muzzle sees. The caller casts rays() and passes the hits to
// take(), until rays() is empty. The survey first finds the farthest surface and a rough picture.
// After refine() it continues to the map. `./dev bench sspm` prints the number of rays per shot.
#pragma once

#include <cmath>
#include <span>
#include <unordered_map>
#include <vector>

#include "shot_map.h"

namespace grisaille::sspm {

// A quad of a visible surface. Corners and centre are offsets from the muzzle, clipped to the
// cylinder.
struct Patch {
  glm::vec3 corners[4];
  glm::vec3 centre;
  glm::vec4 plane;      // normal towards the muzzle; dot(normal, offset)
  bool ragged = false;  // next to a depth discontinuity
  bool whole = true;    // not clipped
  // If several planes share a square: points at which rays hit this one. It may be anywhere in the
  // square. Else empty.
  std::vector<glm::vec3> seen = {};
};

// Whether `plane` may replace the plane `other` at the offset `at`. bias: of the shot's frame.
inline bool serves(const glm::vec4& plane, const glm::vec3& at, const glm::vec4& other,
                   float bias) {
  return std::abs(glm::dot(glm::vec3(plane), at) - plane.w) <= 0.25f * bias &&
         glm::dot(glm::vec3(plane), glm::vec3(other)) > 0.98f;
}

class Survey {
 public:
  // range: metres, > 0.
  Survey(const Shot& shot, float range);

  // Rays to cast next; pass their hits to take(). Empty: the rough picture or the map is complete.
  std::span<const grisaille_ray> rays() const { return rays_; }
  // Takes one hit per ray. False: the host cannot tell yet how far the shot reaches; start a new
  // survey later.
  bool take(std::span<const grisaille_hit> hits);

  // Continues from the rough picture to the map.
  void refine();
  bool isRough() const { return stage_ != Stage::kFine; }

  // Number of squares of which the host could not tell: of all, and of those within one range of
  // the axis. The map has no paint in them.
  size_t unknown() const { return countUnknown(1e30f); }
  size_t unknownInside() const { return countUnknown(1); }
  // Casts their rays again, after the map is complete.
  void askAgain();

  // Visible surfaces in range. Call it when rays() is empty.
  std::vector<Patch> patches() const;
  const ShotFrame& frame() const { return frame_; }
  // The map. Call it after refine(), when rays() is empty.
  ShotMap map();

 private:
  enum class Stage : uint8_t { kProbing, kRough, kFine };
  struct Sample {
    bool hit = false;
    bool unknown = false;  // the host cannot tell: `hit` is set, with a plane behind the muzzle
    glm::vec4 plane = glm::vec4(0);  // as in Patch
    glm::vec3 at = glm::vec3(0);     // offset of the hit
  };
  // A square of the map under construction.
  struct Square {
    glm::vec2 centre = glm::vec2(0);
    float size = 0;
    int32_t children = -1;  // index of the first of 16
    // For an open square, the index of a neighbour with a surface, or -1. `beside`: the surface
    // ends between the two; `rim`: it leaves the cylinder there.
    int32_t beside = -1, rim = -1;
    glm::ivec2 corner = glm::ivec2(0);  // lower corner, in finest squares from the map's
    Sample sample = {};
    bool edge = false;    // a neighbour sees another surface
    bool ragged = false;  // and the two surfaces do not meet: a depth discontinuity
  };
  // Sizes of undivided squares: within one unit of the centre, within three, and beyond.
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
  int probes_ = 0;     // rounds of probing
  bool anew_ = false;  // the next take() finds all edges again
  std::vector<Square> squares_;
  std::vector<int32_t> asked_;  // squares of rays_, in order
  std::vector<grisaille_ray> rays_;
  std::unordered_map<uint64_t, uint32_t> planes_;
};

}  // namespace grisaille::sspm
