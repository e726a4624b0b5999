#pragma once
// Private to the layer.
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "abut/input/fault.hpp"

namespace abut::input {

/// A key that a scene gives. It waits for what reads it: `mark_keys_read` lets each part of a run read the keys that it
/// acts by.
struct GivenKey {
    std::string path;   ///< "bodies.left.young"
    std::string where;  ///< Fault::where
    bool asks = true;   ///< false: 0, false or the default, which ask for nothing
    bool is_read = false;
    std::string why{};     ///< "without contact.friction"; ends the message about a key that nothing reads
    std::string remedy{};  ///< "Give both, or leave it out."
};

/// Keys of a table, by name. Copies share them: a key that one of them reads is read.
class GivenKeys {
public:
    /// In the place of one of this name, which stays unread for those that hold this alone.
    void add(const std::string& name, std::shared_ptr<GivenKey> key) { keys_[name] = std::move(key); }
    void add(const GivenKeys& others) {
        for (const auto& [name, key] : others.keys_) keys_[name] = key;
    }
    void remove(const std::string& name) { keys_.erase(name); }
    [[nodiscard]] bool has(const std::string& name) const { return keys_.contains(name); }
    [[nodiscard]] std::vector<std::string> names() const;

    void read(const std::string& name) const;
    /// Reads the key if it `acts`; else it has no effect without `other`: "law = \"j2\"".
    void read_with(bool acts, const std::string& name, const std::string& other) const;
    /// Reads the key unless `other` `has_precedence`; else it has no effect beside `other`.
    void read_unless(bool has_precedence, const std::string& name, const std::string& other) const;

private:
    void leave(const std::string& name, const std::string& why, const char* remedy) const;

    std::map<std::string, std::shared_ptr<GivenKey>> keys_;
};

/// One for each key that asks for something and that nothing has read. Of a table that nothing reads the table alone is
/// named.
[[nodiscard]] std::vector<Fault> faults_of_unread(const std::vector<std::shared_ptr<GivenKey>>& keys);

}  // namespace abut::input
