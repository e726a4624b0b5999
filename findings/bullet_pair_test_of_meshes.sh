#!/bin/bash
# Bullet: contactPairTest of two GImpact meshes
# Packages of Debian 12: libbullet-dev=3.24+dfsg-2, libbullet3.24=3.24+dfsg-2. Needs g++.
# Guess: once btGImpactCollisionAlgorithm is registered, contactPairTest finds contacts of two GImpact meshes that overlap by
#   0.1 m, as a step of detection does.
# Seen: contactPairTest finds none, with or without the registration, since it takes its algorithms from another table
#   (closest points) in which GImpact is not. performDiscreteCollisionDetection finds them.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libbullet-dev=3.24+dfsg-2 libbullet3.24=3.24+dfsg-2
for deb in *.deb; do dpkg -x "$deb" .; done
include="$work/usr/include" lib="$work/usr/lib/x86_64-linux-gnu"
libraries=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH="$libraries"

cat > a.cpp <<'E'
#include <btBulletCollisionCommon.h>
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <cstdio>
// Corners of the unit cube and its faces, seen from outside.
const double corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
const int face[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                         {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
struct Counter : btCollisionWorld::ContactResultCallback {
    int n = 0;
    btScalar addSingleResult(btManifoldPoint&, const btCollisionObjectWrapper*, int, int, const btCollisionObjectWrapper*, int, int) override {
        ++n;
        return 0;
    }
};
int main() {
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher(&configuration);
    btDbvtBroadphase broad_phase;
    btCollisionWorld world(&dispatcher, &broad_phase, &configuration);
    btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher);
    btTriangleMesh triangles;
    const auto point = [](int i) { return btVector3(corner[i][0], corner[i][1], corner[i][2]); };
    for (auto& t : face) triangles.addTriangle(point(t[0]), point(t[1]), point(t[2]));
    btGImpactMeshShape shape_1(&triangles), shape_2(&triangles);
    btCollisionObject one, two;
    for (auto [object, shape] : {std::pair{&one, &shape_1}, {&two, &shape_2}}) {
        shape->updateBound();
        object->setCollisionShape(shape);
        world.addCollisionObject(object);
    }
    two.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0.9, 0.2, 0.3)));
    Counter pair_test;
    world.contactPairTest(&one, &two, pair_test);
    world.performDiscreteCollisionDetection();
    int n = 0;
    for (int i = 0; i < dispatcher.getNumManifolds(); ++i) n += dispatcher.getManifoldByIndexInternal(i)->getNumContacts();
    std::printf("contactPairTest: %d, detection finds some: %s\n", pair_test.n, n > 0 ? "yes" : "no");
}
E
g++ -O1 -I"$include" -I"$include/bullet" a.cpp -L"$lib" -lBulletCollision -lLinearMath -o a
./a | tee output
diff output - <<'E'
contactPairTest: 0, detection finds some: yes
E
