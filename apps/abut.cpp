// Runs scenes that are TOML files: abut run SCENE, abut check SCENE, abut new NAME, abut keys. docs/scenes.md.
#include "apps/abut/commands.hpp"

int main(int argc, char** argv) { return abut::apps::run_abut(argc, argv); }
