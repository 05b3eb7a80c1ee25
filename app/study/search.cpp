// SPDX-License-Identifier: MIT
#include "app/study/search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace grisaille::app::study {
namespace {

// Steps as shares of a parameter's soft range.
constexpr double kFirstStep = 0.25;
constexpr double kLastStep = 0.03;
// Costs that differ by a smaller share count as equal.
constexpr double kSameCost = 0.02;
// The rate of cost (logarithm) per error until it is measured: an error of 0.01 is worth a fifth of
// the cost.
constexpr double kFirstRate = 20;
constexpr int kMostRounds = 8;

bool meets(const Evaluated& e, const Wish& wish) {
  return wish.maxError > 0 ? e.error <= wish.maxError : e.cost <= wish.budget;
}

bool isOneOfFew(const grisaille_param_desc& param) {
  return param.type == GRISAILLE_PARAM_ENUM || param.type == GRISAILLE_PARAM_BOOL;
}

class Search {
 public:
  Search(const std::vector<Axis>& axes, const Wish& wish, const Oracle& oracle, size_t most)
      : axes_(axes), wish_(wish), oracle_(oracle), most_(most), effects_(axes.size()) {}

  Found run(const std::vector<Point>& starts) {
    for (const Point& start : starts) tryStart(start);
    at_ = found_.best;
    screen();
    for (double step = kFirstStep; step >= kLastStep && goesOn(); step /= 2) {
      // The rate differs from point to point, and steps could go round in circles: limit the
      // rounds.
      for (int round = 0; round < kMostRounds && goesOn(); ++round) {
        settle(step);
        if (!exchange(step)) break;
      }
    }
    settle(kLastStep);
    compareWithFirst();
    found_.meetsWish = meets(found_.best, wish_);
    return found_;
  }

 private:
  // The largest changes that a step along an axis has made so far.
  struct Effect {
    double error = 0;
    double cost = 0;     // of the logarithm of the cost
    int direction = -1;  // the last direction that paid
  };

  bool goesOn() {
    if (!found_.stopped) found_.stopped = oracle_.stop();
    return !found_.stopped && found_.starts + found_.steps < most_;
  }

  void tryStart(const Point& point) {
    if (found_.starts > 0 && (seen_.contains(point) || !goesOn())) return;
    Evaluated start{point, oracle_.error(point), 0};
    start.cost = found_.starts == 0 ? oracle_.cost(point) : oracle_.costBeside(point, found_.best);
    seen_[point] = start;
    if (found_.starts++ == 0) {
      found_.first = found_.best = start;
      if (wish_.maxError > 0 && meets(start, wish_)) mostCost_ = start.cost;
    } else {
      keepIfBetter(start);
    }
  }

  void keepIfBetter(const Evaluated& next) {
    if (next.cost <= mostCost_ && isBetter(next, found_.best, wish_)) found_.best = next;
  }

  // The cost of a step is a product of measured ratios, whose errors add up. Measures the result in
  // turns with the first start itself.
  void compareWithFirst() {
    if (found_.stopped || std::isinf(mostCost_) || found_.best.point == found_.first.point) return;
    found_.best.cost = oracle_.costBeside(found_.best.point, found_.first);
    if (found_.best.cost > mostCost_) found_.best = found_.first;
  }

  // Evaluates the neighbour of at_ along an axis. Does not measure its cost if `ruledOut(error)`.
  // None: the neighbour is ruled out, is at_ itself, or the search must end.
  template <typename RuledOut>
  std::optional<Evaluated> look(size_t axis, double step, int direction, const RuledOut& ruledOut) {
    Point point = at_.point;
    point[axis] = stepped(*axes_[axis].param, point[axis], step, direction);
    if (point == at_.point) return std::nullopt;
    if (const auto known = seen_.find(point); known != seen_.end()) {
      return known->second.cost > 0 ? std::optional(known->second) : std::nullopt;
    }
    if (!goesOn()) return std::nullopt;
    ++found_.steps;
    Evaluated next{point, oracle_.error(point), 0};
    Effect& effect = effects_[axis];
    effect.error = std::max(effect.error, std::abs(next.error - at_.error));
    if (ruledOut(next.error)) {
      ++found_.costsSaved;
      seen_[point] = next;
      return std::nullopt;
    }
    next.cost = oracle_.costBeside(point, at_);
    seen_[point] = next;
    effect.cost = std::max(effect.cost, std::abs(std::log(next.cost / at_.cost)));
    keepIfBetter(next);
    return next;
  }

  // Takes one large step along each axis in either direction, to learn its effect. The axis that
  // changes the cost most becomes the paying axis: it pays for changes of the others.
  void screen() {
    for (size_t axis = 0; axis < axes_.size(); ++axis) {
      for (const int direction : {-1, 1}) {
        const auto next = look(axis, kFirstStep, direction, [](double) { return false; });
        if (next) learn(axis, *next);
        if (!next || !isBetter(*next, at_, wish_)) continue;
        at_ = *next;
        effects_[axis].direction = direction;
        break;
      }
    }
    for (size_t axis = 0; axis < axes_.size(); ++axis) {
      if (!isOneOfFew(*axes_[axis].param) && effects_[axis].cost > effects_[payer_].cost) {
        payer_ = axis;
      }
    }
  }

  // Updates the rate at which the paying axis trades cost for error, if this step traded them.
  void learn(size_t axis, const Evaluated& next) {
    if (axis != payer_) return;
    const double rate = -std::log(next.cost / at_.cost) / (next.error - at_.error);
    if (std::isfinite(rate) && rate > 0) rate_ = rate;
  }

  // Moves along the paying axis to the best point that the wish allows.
  void settle(double step) {
    for (const int direction : {-1, 1}) {
      while (const auto next = look(payer_, step, direction, [](double) { return false; })) {
        learn(payer_, *next);
        if (!isBetter(*next, at_, wish_)) break;
        at_ = *next;
      }
    }
    if (meets(found_.best, wish_) && !meets(at_, wish_)) at_ = found_.best;
  }

  // Takes the steps along the other axes that cost less than the paying axis gains by them. Returns
  // whether it took any.
  bool exchange(double step) {
    bool paid = false;
    for (size_t axis = 0; axis < axes_.size() && goesOn(); ++axis) {
      const Effect& effect = effects_[axis];
      if (axis == payer_ || effect.error == 0) continue;
      if (step < kFirstStep && isOneOfFew(*axes_[axis].param)) continue;
      const int first = effect.direction;
      for (const int direction : {first, -first}) {
        if (!follow(axis, step, direction)) continue;
        effects_[axis].direction = direction;
        paid = true;
        break;
      }
    }
    return paid;
  }

  bool follow(size_t axis, double step, int direction) {
    bool paid = false;
    const auto ruledOut = [&](double error) {
      return error >= at_.error && effects_[axis].cost < kSameCost;
    };
    while (const auto next = look(axis, step, direction, ruledOut)) {
      // If an axis does not change the cost, measured differences are noise of the clock.
      const double ratio = effects_[axis].cost < kSameCost ? 0 : std::log(next->cost / at_.cost);
      if (ratio + rate_ * (next->error - at_.error) >= 0) break;
      at_ = *next;
      paid = true;
    }
    return paid;
  }

  const std::vector<Axis>& axes_;
  const Wish& wish_;
  const Oracle& oracle_;
  size_t most_;
  Found found_;
  Evaluated at_;
  std::map<Point, Evaluated> seen_;
  std::vector<Effect> effects_;
  size_t payer_ = 0;
  double rate_ = kFirstRate;
  double mostCost_ = std::numeric_limits<double>::infinity();  // of the result, milliseconds
};

}  // namespace

bool isBetter(const Evaluated& a, const Evaluated& b, const Wish& wish) {
  const bool good = meets(a, wish);
  if (good != meets(b, wish)) return good;
  if (wish.maxError > 0) {
    if (!good) return a.error < b.error;
    if (a.cost < b.cost * (1 - kSameCost)) return true;
    return a.cost <= b.cost * (1 + kSameCost) && a.error < b.error;
  }
  return good ? a.error < b.error : a.cost < b.cost;
}

double stepped(const grisaille_param_desc& param, double value, double step, int direction) {
  if (param.type == GRISAILLE_PARAM_BOOL) return 1 - value;
  if (param.type == GRISAILLE_PARAM_ENUM) {
    const auto count = static_cast<double>(param.enum_count);
    return std::fmod(value + direction + count, count);
  }
  // The soft range, extended to the value if that is outside.
  const double low = std::min(param.soft_min, value), high = std::max(param.soft_max, value);
  double next = 0;
  if ((param.flags & GRISAILLE_PARAM_LOG) != 0 && low > 0) {
    next = value * std::pow(high / low, step * direction);
  } else {
    next = value + (high - low) * step * direction;
  }
  if (param.type == GRISAILLE_PARAM_INT) {
    next = std::round(next);
    if (next == value) next += direction;
  }
  return std::clamp(next, low, high);
}

Found search(const std::vector<Axis>& axes, const std::vector<Point>& starts, const Wish& wish,
             const Oracle& oracle, size_t mostEvaluations) {
  return Search(axes, wish, oracle, mostEvaluations).run(starts);
}

}  // namespace grisaille::app::study
