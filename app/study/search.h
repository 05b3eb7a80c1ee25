// SPDX-License-Identifier: MIT
// Finds the cheapest setting within an error, or the most accurate one within a cost, in few
// evaluations. It is a pattern search (Hooke and Jeeves 1961, "'Direct Search' Solution of
// Numerical and Statistical Problems"): it changes one parameter at a time and continues in a
// direction that paid. It first finds the parameter that changes the cost most (kernel size, for
// example), which then pays for the others. The search moves it until the wish is just met. This
// shows the rate at which cost buys accuracy there. A step of another parameter is taken if it buys
// accuracy at a lower rate.
//
// Why not a grid: with p parameters of v values each, a grid has v^p settings, and most of them are
// wrong in every parameter at once. The cost of this search grows linearly with p. It does not
// measure the cost of a step that the error alone rules out.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/effect/parameter_name.h"
#include "core/effect/registry.h"

namespace grisaille::app::study {

// One parameter that may change: a column of a point.
struct Axis {
  effect::ParameterName name;
  const grisaille_param_desc* param = nullptr;
};

// One value per axis, in the unit of its parameter.
using Point = std::vector<double>;

// The goal of a search. Exactly one of the two is above 0.
struct Wish {
  double maxError = 0;  // RMSE
  double budget = 0;    // milliseconds
};

struct Evaluated {
  Point point;
  double error = 0;
  double cost = 0;  // milliseconds; 0: never measured
};

// Evaluates settings for the search. costBeside() measures a cost in turns with that of a setting
// of known cost, so that other load of the machine affects both.
struct Oracle {
  std::function<double(const Point&)> error;
  std::function<double(const Point&)> cost;
  std::function<double(const Point& point, const Evaluated& known)> costBeside;
  std::function<bool()> stop;  // called before each evaluation; true ends the search
};

struct Found {
  Evaluated best;
  Evaluated first;  // the first of the starting points
  bool meetsWish = false;
  bool stopped = false;
  size_t starts = 0;      // evaluations of the starting points
  size_t steps = 0;       // all other evaluations
  size_t costsSaved = 0;  // steps that the error alone ruled out, with no cost measured
};

// Starts at the best of `starts` (at least one). Ends when no step of the smallest size helps,
// after `mostEvaluations`, or when Oracle::stop returns true. The first start is the setting that
// the user has: if it meets a maximal error, the result costs at most as much, measured in turns
// with it.
Found search(const std::vector<Axis>& axes, const std::vector<Point>& starts, const Wish& wish,
             const Oracle& oracle, size_t mostEvaluations);

// Whether `a` fulfils the wish better than `b`:
//
// - If only one of them meets the wish, that one is better.
// - If both meet a maximal error, the cheaper one is better. If their costs agree within 2 %, the
//   repeatability of a clock, the more accurate one is better.
// - If both meet a budget, the more accurate one is better.
// - If neither meets the wish, the one nearer to it is better.
bool isBetter(const Evaluated& a, const Evaluated& b, const Wish& wish);

// The next value of a parameter from `value`: `step` times its soft range up or down (`direction` 1
// or -1), on a logarithmic scale if the parameter has one. Whole numbers move by at least 1.
// Enumerations and booleans move by one entry and wrap around. Returns `value` at the end of the
// range.
double stepped(const grisaille_param_desc& param, double value, double step, int direction);

}  // namespace grisaille::app::study
