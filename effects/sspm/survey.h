// SPDX-License-Identifier: MIT
// Surveys by ray casts what a shot's muzzle sees. The caller casts rays() and passes the hits to
// take(), until rays() is empty. The survey first finds the farthest surface and a rough picture.
// After refine() it continues to the map. `./dev bench sspm` prints the number of rays per shot.
//
// Rays go through corners of the map's squares, so that neighbours share them. What a square's four
// corners see decides:
// - one plane serves all: a leaf with that plane;
// - two planes that meet there: a leaf divided by the line where they meet;
// - two planes, one in front of the other: rays by bisection find where the silhouette crosses two
//   of its sides, and the line through both places divides the leaf;
// - more: four squares of half the width.
// A ray through the centre must confirm a line; otherwise the square is divided too.
#pragma once

#include <array>
#include <cmath>
#include <span>
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
  // How far squares are divided: for both maps, or as far as the coarse one needs.
  enum class Detail : uint8_t { kExact, kCoarse };

  // range: metres, > 0.
  Survey(const Shot& shot, float range, Detail detail = Detail::kExact);
  bool isCoarse() const { return detail_ == Detail::kCoarse; }

  // Rays to cast next; pass their hits to take(). Empty: the rough picture or the map is complete.
  std::span<const grisaille_ray> rays() const { return rays_; }
  // Takes one hit per ray. False: the host cannot tell yet how far the shot reaches; start a new
  // survey later.
  bool take(std::span<const grisaille_hit> hits);

  // Continues from the rough picture to the map.
  void refine();
  bool isRough() const { return stage_ != Stage::kFine; }
  // Number of rays that the rough picture and the map have taken so far.
  size_t cast() const { return samples_.size(); }

  // Number of rays of which the host could not tell: of all, and of those within one range of the
  // axis. The map has no paint in their squares.
  size_t unknown() const { return countUnknown(1e30f); }
  size_t unknownInside() const { return countUnknown(1); }
  // Casts their rays again, after the map is complete. Repeated calls without answers do nothing.
  void askAgain();

  // Memory, bytes.
  size_t bytes() const;

  // Visible surfaces in range. Call it when rays() is empty.
  std::vector<Patch> patches() const;
  const ShotFrame& frame() const { return frame_; }
  // The map. Call it after refine(), when rays() is empty.
  ShotMap map() const;
  // A map about a third as large. Its planes serve all but small parts of the squares.
  ShotMap coarseMap() const;

 private:
  enum class Stage : uint8_t { kProbing, kRough, kFine };
  // What a ray saw.
  struct Sample {
    bool told = false;  // the ray was cast
    bool hit = false;
    bool unknown = false;              // the host cannot tell
    glm::ivec2 place = glm::ivec2(0);  // on the map, in finest squares from its lower corner
    glm::vec4 plane = glm::vec4(0);    // as in Patch, rounded: see planeOf()
    glm::vec3 at = glm::vec3(0);       // offset of the hit
    float across = 0;                  // distance of the hit from the shot's ray, metres
  };
  enum class Kind : uint8_t {
    kUndecided,
    kDivided,
    kNothing,
    kUntold,
    kOnePlane,
    kTwoPlanes,
    kSeveral
  };
  // In place of a sample that all leaves below a square share.
  static constexpr int32_t kEmpty = -1;  // they see no surface
  static constexpr int32_t kMixed = -2;  // no plane serves all
  enum class Side : uint8_t { kFar, kNear, kNeither };
  // A square of the map under construction. Sizes and corners count finest squares.
  struct Square {
    glm::ivec2 corner = glm::ivec2(0);
    int32_t size = 0;
    Kind kind = Kind::kUndecided;
    bool ragged = false;    // contains a depth discontinuity
    bool doubtful = false;  // lies beside one
    bool blocked = false;   // one plane serves its corners, but not all of it
    bool open = false;      // lies across an edge of the surface, and hides nothing
    enum class Step : uint8_t { kPlane, kCrease, kSilhouette } step = Step::kPlane;
    int32_t children = -1;            // index of the first of four, by rows
    int32_t first = -1, second = -1;  // samples of its planes
    // Sample of the plane that serves all leaves below, or kEmpty or kMixed: see unite().
    int32_t uniform = kMixed;
    std::array<int32_t, 4> corners = {-1, -1, -1, -1};  // samples, by rows
    MapLine line = {};
    float shift = 0;          // of the first plane towards what lies behind it, metres
    int32_t silhouette = -1;  // index into silhouettes_
  };
  // Bisection of one side of a square, from what one of its corners sees.
  struct Bisection {
    glm::ivec2 from = glm::ivec2(0), to = glm::ivec2(0);
    Side start = Side::kNeither;
    int32_t last = 0;     // width of the last interval
    int32_t middle = -1;  // sample between `from` and `to`
  };
  // Where a silhouette crosses two sides of a square, as far as rays have found it.
  struct Silhouette {
    std::array<Bisection, 2> crossings = {};
    glm::vec2 towards = glm::vec2(0);  // from the far corners to the near ones, units
  };
  // Two planes that may divide a square, as samples. `far` lies behind.
  struct Pair {
    int32_t far = -1, near = -1;
  };
  // For each corner of a square, how far the hits of all corners are from its plane: see misfit().
  using Misfits = std::array<std::array<float, 4>, 4>;
  using Corners = std::array<bool, 4>;              // some of a square's corners
  enum class Found : uint8_t { kYes, kNo, kWait };  // kWait: rays were asked for
  struct SeenPlane {
    const Sample* sample;
    std::vector<glm::vec3> seen;
  };

  Square& at(int32_t index) { return squares_[static_cast<size_t>(index)]; }
  const Square& at(int32_t index) const { return squares_[static_cast<size_t>(index)]; }
  const Sample& sample(int32_t index) const { return samples_[static_cast<size_t>(index)]; }

  // survey.cpp: which rays to cast
  void scaleTo(float farthest);
  void probe(float farthest);
  bool probed();
  size_t countUnknown(float within) const;
  int32_t ask(const glm::ivec2& place);
  glm::vec4 planeOf(const glm::vec3& normal, const glm::vec3& at) const;
  void writeRays();
  void begin();
  void start();
  void advance();
  void doubt();
  void follow();
  bool seesAtSides(const Square& square) const;
  std::array<int32_t, 4> neighboursOf(const Square& square) const;
  int32_t leafAt(const glm::ivec2& place) const;
  int32_t grainAt(const Square& square) const;
  bool isCalm(const Square& square) const;
  int32_t known(const glm::ivec2& place) const;
  size_t slotOf(const glm::ivec2& place) const;
  void growSlots();
  void divide(int32_t index);
  bool inRange(const Sample& sample) const;
  int32_t finestAt(const Square& square) const;
  float sizeOf(const Square& square) const;  // in units of the map
  glm::vec2 centreOf(const Square& square) const;

  // survey_squares.cpp: what a square sees
  bool decide(int32_t index);
  Found findLine(Square& square);
  float misfit(int32_t plane, int32_t other) const;
  Misfits misfitsOf(const Square& square) const;
  Found findPlane(Square& square, const Misfits& misfits, bool within);
  bool isAcrossEdge(const Square& square) const;
  bool findPair(Square& square, const Misfits& misfits) const;
  Side sideOf(const Pair& pair, int32_t index) const;
  bool findCrease(const Square& square, const Pair& pair, MapLine& line) const;
  bool startSilhouette(Square& square, const Pair& pair);
  Found findSilhouette(Square& square, const Pair& pair);
  Found narrow(const Pair& pair, Bisection& side);
  Found confirm(const Square& square, const Pair& pair, const MapLine& line);
  void settle(Square& square);
  Corners nearCorners(const Square& square) const;
  bool lineBetween(const Square& square, const Corners& near, MapLine& line) const;
  int32_t farthestPlane(const Square& square, const Corners& some) const;

  // survey_map.cpp
  class Writer;
  ShotMap write(int32_t least, float most) const;

  // survey_results.cpp: patches; and what a map's leaves may share
  void gatherPatches(int32_t index, std::vector<Patch>& patches) const;
  void gatherPlanes(int32_t index, std::vector<SeenPlane>& planes, bool& ragged) const;
  Patch patchOf(const Square& square, const glm::vec4& plane) const;
  bool serves(int32_t index, const glm::vec4& plane) const;
  const Sample* firstPlane(int32_t index) const;
  void unite();
  int32_t unitedBy(int32_t index) const;

  ShotFrame frame_;
  Detail detail_;
  Stage stage_ = Stage::kProbing;
  float farthest_ = 0;
  int probes_ = 0;      // rounds of probing
  int32_t finest_ = 1;  // width of a bisection's last interval; squares are twice as wide
  std::vector<Sample> samples_;
  // Hash table of samples_ by place, with linear probing.
  struct Slot {
    uint32_t place = 0;   // x, and y << 16
    int32_t sample = -1;  // -1: free
  };
  std::vector<Slot> slots_;
  std::vector<Square> squares_;
  std::vector<Silhouette> silhouettes_;
  std::vector<int32_t> undecided_;
  std::vector<int32_t> ragged_;  // squares of which doubt() has not told their neighbours
  std::vector<int32_t> asked_;   // samples of rays_, in order
  std::vector<grisaille_ray> rays_;
};

}  // namespace grisaille::sspm
