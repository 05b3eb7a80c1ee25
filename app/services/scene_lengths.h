// SPDX-License-Identifier: MIT
// Chooses the lengths of a scene that nobody has set: the radius of ambient occlusion, and the
// parameters with GRISAILLE_PARAM_SCENE_LENGTH, from what the scene's default camera sees.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/effect/selection.h"
#include "core/image/image.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"

namespace grisaille::app {

// The radius that suits the tables' defaults of scene lengths, and scenes that cannot be measured,
// metres.
constexpr double kUsualRadius = 0.5;

// A radius of ambient occlusion that suits the surfaces of a depth picture, in metres, rounded to
// one or two digits. None if the picture shows no surface of any extent.
// depth: view depth in metres, one channel; 0: no surface
std::optional<double> suitableRadius(const image::Image& depth, const scene::Camera& camera);

// The same for a scene: from the depths that its default camera sees. Depends on the scene alone. A
// scene of s times the size has a radius of about s times the length.
double suitableRadius(const scene::Scene& scene);

// The value of a scene length where `radius` suits ambient occlusion: its default, scaled and
// rounded, within its range.
double lengthAt(const grisaille_param_desc& param, double radius);

// Makes lengthAt() the default of the scene lengths of all effects. Values that somebody has set
// stay.
void fitLengths(effect::Selection& selection, double radius);

// The lengths of active effects that nobody has set.
std::vector<effect::ParameterValue> lengthsOf(const effect::Selection& selection);

// Fit the lengths that nobody has set to a scene, or to the surfaces of a depth picture, and print
// them: see printChosen(). Do nothing if there are none.
void fitToScene(effect::Selection& selection, const scene::Scene& scene);
void fitToDepth(effect::Selection& selection, const image::Image& depth,
                const scene::Camera& camera);

// Prints one line to standard error that names the lengths of active effects that nobody has set.
// Leaves out those that equal the table's default, and prints nothing if no other is left.
// radius: the value of --radius, if that was chosen too
// what: what they were chosen for: "the scene"
void printChosen(const effect::Selection& selection, std::optional<double> radius,
                 const std::string& what);

}  // namespace grisaille::app
