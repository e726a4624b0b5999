#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "abut/mesh/surface_mesh.hpp"
#include "apps/support/command_line.hpp"

namespace abut::apps {

/// "shape:key=value,key=value". What is read keeps its value where its key is not given. All throw BadInput naming the text.
class Keys {
public:
    /// The keys stand behind the character at `colon`; npos: there are none.
    Keys(std::string text, std::size_t colon);

    void read(const std::string& key, std::string& value) const;
    void read(const std::string& key, double& value) const { read(key, value, {}); }
    void read(const std::string& key, double& value, const Limits& limits) const;
    void read(const std::string& key, int& value) const;
    void read(const std::string& key, bool& value) const;
    void read(const std::string& key, std::uint64_t& value) const;
    [[nodiscard]] bool empty() const { return values_.empty(); }
    void check_known(const std::vector<std::string>& known) const;
    [[noreturn]] void refuse(const std::string& what) const;

private:
    void add(const std::string& entry);

    std::string text_;
    std::map<std::string, std::string> values_;
};

/// A file as the command line names it: its path, and the keys behind it.
struct PlacedFile {
    std::string path;
    Keys keys;
};
/// "left.stl:unit=mm,x=1"; a file that is called so is one without keys.
[[nodiscard]] PlacedFile placed_file(const std::string& text);

/// Keys of every input: how it is scaled, turned and moved.
[[nodiscard]] std::vector<std::string> placing_keys();
/// In this order: lengths are those of `unit` times `scale`; turned about the origin by the rotation vector rx, ry, rz
/// [degrees]; moved by x, y, z [m]. `flip` turns all faces round; `name` names the body, or stands in front of the
/// names of several.
void place(mesh::SurfaceMesh& surface, const Keys& keys);

/// Units and keys for --help.
[[nodiscard]] std::string placing_help();

}  // namespace abut::apps
