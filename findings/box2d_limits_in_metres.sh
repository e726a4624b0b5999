#!/bin/bash
# Box2D: a ball without losses, slow and fast
# Packages of Debian 12: libbox2d-dev=2.4.1-3, libbox2d2=2.4.1-3. Needs g++.
# Guess: with restitution 1 a ball leaves a wall as fast as it came, and without forces it flies on as it was sent.
# Seen: below 1 m/s it stays at the wall, whatever its size (restitutionThreshold of the fixture). No body moves by more than 2 m
#   in a step: a faster one is slowed down for good, in silence. Both limits are lengths in metres, so that a model in
#   millimetres, or of bullets, is another one.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libbox2d-dev=2.4.1-3 libbox2d2=2.4.1-3
for deb in *.deb; do dpkg -x "$deb" .; done
libraries=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH="$libraries"

cat > a.cpp <<'E'
#include <box2d/box2d.h>

#include <cstdio>
#include <initializer_list>

b2Body* ball(b2World& world, float height, float velocity) {
    b2BodyDef body;
    body.type = b2_dynamicBody;
    body.position.Set(0, height);
    body.linearVelocity.Set(0, velocity);
    b2CircleShape circle;
    circle.m_radius = 0.5f;
    b2FixtureDef fixture;
    fixture.shape = &circle;
    fixture.density = 1;
    fixture.restitution = 1;
    b2Body* made = world.CreateBody(&body);
    made->CreateFixture(&fixture);
    return made;
}

int main() {
    for (const float speed : {0.5f, 0.9f, 1.1f, 10.0f}) {
        b2World world(b2Vec2(0, 0));
        b2BodyDef ground;
        b2EdgeShape edge;
        edge.SetTwoSided(b2Vec2(-10, 0), b2Vec2(10, 0));
        world.CreateBody(&ground)->CreateFixture(&edge, 0);
        b2Body* moving = ball(world, 1, -speed);
        for (int i = 0; i < 400; ++i) world.Step(1 / 200.0f, 8, 3);
        std::printf("comes at %.1f m/s, leaves at %.1f m/s\n", speed, moving->GetLinearVelocity().y);
    }
    for (const int steps : {60, 240}) {
        b2World world(b2Vec2(0, 0));
        b2Body* moving = ball(world, 0, 300);
        for (int i = 0; i < steps; ++i) world.Step(1.0f / steps, 8, 3);
        std::printf("sent at 300 m/s, %d steps a second: after a second at %.0f m with %.0f m/s\n", steps, moving->GetPosition().y,
                    moving->GetLinearVelocity().y);
    }
}
E
g++ -O1 a.cpp -I"$work/usr/include" -L"$work/usr/lib/x86_64-linux-gnu" -L"$work/usr/lib" -lbox2d -o a
./a | tee output
diff output - <<'E'
comes at 0.5 m/s, leaves at 0.0 m/s
comes at 0.9 m/s, leaves at 0.0 m/s
comes at 1.1 m/s, leaves at 1.1 m/s
comes at 10.0 m/s, leaves at 10.0 m/s
sent at 300 m/s, 60 steps a second: after a second at 120 m with 120 m/s
sent at 300 m/s, 240 steps a second: after a second at 300 m with 300 m/s
E
