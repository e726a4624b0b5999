#!/bin/bash
# Embree: bounds of a scene with one user primitive
# Packages of Debian 12: libembree-dev=3.13.5+dfsg-2, libembree3-3=3.13.5+dfsg-2. Needs g++.
# Guess: callbacks of user geometry are called where the bounds that it gave are hit, so that a far ray, a far point query and
#   rtcCollide with a scene far away call none.
# Seen: with one primitive in the scene all three call it, wherever it is; with two or more none does. A callback must test
#   its own bounds.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libembree-dev=3.13.5+dfsg-2 libembree3-3=3.13.5+dfsg-2
for deb in *.deb; do dpkg -x "$deb" .; done
include="$work/usr/include" lib="$work/usr/lib/x86_64-linux-gnu"
libraries=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH="$libraries"

cat > a.cpp <<'E'
#include <embree3/rtcore.h>
#include <initializer_list>
#include <cstdio>
int asked = 0;
void bounds(const RTCBoundsFunctionArguments* a) {
    const float x = *static_cast<float*>(a->geometryUserPtr) + 10.0f * static_cast<float>(a->primID);
    *a->bounds_o = {x, 0, 0, 0, x + 1, 1, 1, 0};
}
void hit(const RTCIntersectFunctionNArguments*) { ++asked; }
bool near(RTCPointQueryFunctionArguments*) { return ++asked, false; }
void collided(void*, RTCCollision*, unsigned n) { asked += static_cast<int>(n); }
RTCScene scene_of(RTCDevice device, unsigned n, float* x) {
    const RTCScene scene = rtcNewScene(device);
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, n);
    rtcSetGeometryUserData(geometry, x);
    rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry, hit);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcCommitScene(scene);
    return scene;
}
int main() {
    const RTCDevice device = rtcNewDevice(nullptr);
    float here = 0, far = 1000;
    for (const unsigned n : {1u, 2u, 8u}) {
        const RTCScene scene = scene_of(device, n, &here), other = scene_of(device, 1, &far);
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRayHit ray{};
        ray.ray.org_x = ray.ray.org_y = 500;
        ray.ray.dir_z = 1;
        ray.ray.tfar = 1e9f;
        ray.ray.mask = ~0u;
        rtcIntersect1(scene, &context, &ray);
        std::printf("%u in the scene: ray %d,", n, asked), asked = 0;
        RTCPointQuery query{500, 500, 0, 0, 1};
        RTCPointQueryContext point_context;
        rtcInitPointQueryContext(&point_context);
        rtcPointQuery(scene, &query, &point_context, near, nullptr);
        std::printf(" point query %d,", asked), asked = 0;
        rtcCollide(scene, other, collided, nullptr);
        std::printf(" collisions %d\n", asked), asked = 0;
    }
}
E
g++ -O1 -I"$include" a.cpp -L"$lib" -lembree3 -o a
./a | tee output
diff output - <<'E'
1 in the scene: ray 1, point query 1, collisions 1
2 in the scene: ray 0, point query 0, collisions 0
8 in the scene: ray 0, point query 0, collisions 0
E
