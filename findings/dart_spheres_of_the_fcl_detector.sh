#!/bin/bash
# DART: two spheres and its detector by FCL
# Packages of Debian 12: libdart-dev=6.12.1+dfsg4-12+b2, libdart6.12 of the same version, libfcl-dev=0.7.0-3+b1. Needs g++.
# Guess: two spheres of radius 1 m whose centres are 1.9 m apart touch, whatever the direction, with a normal along their centres.
# Seen: FCLCollisionDetector, as it is created, takes spheres as meshes. Along an axis the normal is 25 degrees off the line of
#   centres. Along (1, 0.7, 0.3) there is no contact, where the spheres are 0.1 m deep in each other. DARTCollisionDetector has both.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
version=6.12.1+dfsg4-12+b2
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libdart-dev=$version libdart6.12=$version libfcl-dev=0.7.0-3+b1 libfcl0.7=0.7.0-3+b1 libeigen3-dev=3.4.0-4 \
    libccd-dev=2.1-2+b1 libccd2=2.1-2+b1 libassimp-dev=5.2.5~ds0-1+b1 libassimp5=5.2.5~ds0-1+b1
for deb in *.deb; do dpkg -x "$deb" .; done
libraries=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH="$libraries"

cat > a.cpp <<'E'
#include <cmath>
#include <cstdio>
#include <dart/collision/dart/DARTCollisionDetector.hpp>
#include <dart/collision/fcl/FCLCollisionDetector.hpp>
#include <dart/dynamics/SimpleFrame.hpp>
#include <dart/dynamics/SphereShape.hpp>
using namespace dart;
struct Seen {
    std::size_t contacts;
    double depth = 0.0, cosine = 0.0;
};
Seen look(const collision::CollisionDetectorPtr& detector, const Eigen::Vector3d& direction) {
    const auto sphere = std::make_shared<dynamics::SphereShape>(1.0);
    const auto a = dynamics::SimpleFrame::createShared(dynamics::Frame::World());
    const auto b = dynamics::SimpleFrame::createShared(dynamics::Frame::World());
    a->setShape(sphere), b->setShape(sphere), b->setTranslation(1.9 * direction);
    const auto group_a = detector->createCollisionGroup(a.get()), group_b = detector->createCollisionGroup(b.get());
    collision::CollisionResult result;
    group_a->collide(group_b.get(), collision::CollisionOption(), &result);
    Seen seen{result.getNumContacts()};
    for (const auto& contact : result.getContacts()) {
        seen.depth = std::fmax(seen.depth, contact.penetrationDepth);
        seen.cosine = std::fmax(seen.cosine, std::fabs(contact.normal.dot(direction)));
    }
    std::printf("%s along (%.2f, %.2f, %.2f): %zu contacts, depth %.4f m, cosine of the normal %.4f\n", detector->getType().c_str(),
                direction.x(), direction.y(), direction.z(), seen.contacts, seen.depth, seen.cosine);
    return seen;
}
int main() {
    const Eigen::Vector3d along = Eigen::Vector3d::UnitX(), aside = Eigen::Vector3d(1.0, 0.7, 0.3).normalized();
    const auto fcl = collision::FCLCollisionDetector::create();
    const auto exact = collision::DARTCollisionDetector::create();
    const Seen tilted = look(fcl, along), missed = look(fcl, aside);
    bool good = tilted.contacts > 0 && std::fabs(tilted.cosine - 0.9087) < 0.001 && missed.contacts == 0;
    for (const Eigen::Vector3d& direction : {along, aside}) {
        const Seen seen = look(exact, direction);
        good = good && seen.contacts == 1 && std::fabs(seen.depth - 0.1) < 1e-9 && std::fabs(seen.cosine - 1.0) < 1e-9;
    }
    return good ? 0 : 1;
}
E
g++ -O0 -std=c++17 a.cpp -o a -I"$work/usr/include" -I"$work/usr/include/eigen3" -L"$work/usr/lib/x86_64-linux-gnu" \
    -ldart -lassimp -lfcl -lccd -Wl,-rpath-link,"$libraries"
./a
