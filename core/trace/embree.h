// SPDX-License-Identifier: MIT
// Wraps the calls that differ between Embree 3 and 4. All other Embree calls of this folder are the
// same in both. CMake defines GRISAILLE_EMBREE_MAJOR.
#pragma once

#include <glm/glm.hpp>

#if GRISAILLE_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace grisaille::trace::embree {

#if GRISAILLE_EMBREE_MAJOR >= 4

using Context = RTCRayQueryContext;
// The scene calls the filter of a query, after the filter of the geometry.
constexpr RTCSceneFlags kFilterOfQuery = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;

template <typename Arguments>
void fill(Arguments& arguments, Context& context, RTCFilterFunctionN filter) {
  rtcInitRayQueryContext(&context);
  arguments.context = &context;
  arguments.filter = filter;
  if (filter != nullptr) arguments.flags = RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER;
}

#else

using Context = RTCIntersectContext;
constexpr RTCSceneFlags kFilterOfQuery = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;

inline void fill(Context& context, RTCFilterFunctionN filter) {
  rtcInitIntersectContext(&context);
  context.filter = filter;
}

#endif

// A ray that has hit nothing. near, far: distances between which it is cast, in lengths of
// `direction`.
inline RTCRayHit makeRay(const glm::vec3& origin, const glm::vec3& direction, float near,
                         float far) {
  RTCRayHit ray = {};
  ray.ray.org_x = origin.x;
  ray.ray.org_y = origin.y;
  ray.ray.org_z = origin.z;
  ray.ray.tnear = near;
  ray.ray.dir_x = direction.x;
  ray.ray.dir_y = direction.y;
  ray.ray.dir_z = direction.z;
  ray.ray.tfar = far;
  ray.ray.mask = ~0u;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return ray;
}

// Each query initialises `context` and passes it to Embree, and Embree passes it to `filter`. To
// give a filter more data, make the context the first member of a struct. `filter` may be null.

inline void intersect1(RTCScene scene, Context& context, RTCFilterFunctionN filter,
                       RTCRayHit& ray) {
#if GRISAILLE_EMBREE_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  fill(arguments, context, filter);
  rtcIntersect1(scene, &ray, &arguments);
#else
  fill(context, filter);
  rtcIntersect1(scene, &context, &ray);
#endif
}

// Traces a packet of coherent rays. `valid`: 16 values, -1 for each active ray, else 0; aligned to
// 64 bytes.
inline void intersect16(const int* valid, RTCScene scene, Context& context,
                        RTCFilterFunctionN filter, RTCRayHit16& rays) {
#if GRISAILLE_EMBREE_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  fill(arguments, context, filter);
  arguments.flags = static_cast<RTCRayQueryFlags>(arguments.flags | RTC_RAY_QUERY_FLAG_COHERENT);
  rtcIntersect16(valid, scene, &rays, &arguments);
#else
  fill(context, filter);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid, scene, &context, &rays);
#endif
}

// Embree sets `ray.tfar` to minus infinity if the ray is blocked.
inline void occluded1(RTCScene scene, Context& context, RTCRay& ray) {
#if GRISAILLE_EMBREE_MAJOR >= 4
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  fill(arguments, context, nullptr);
  rtcOccluded1(scene, &ray, &arguments);
#else
  fill(context, nullptr);
  rtcOccluded1(scene, &context, &ray);
#endif
}

}  // namespace grisaille::trace::embree
