#pragma once
#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace abut::test::programs {

/// A program that runs beside the test; killed with the object if it has not ended.
class Child {
public:
    /// Its standard output goes to the file, its errors are thrown away. Throws std::runtime_error if it cannot be started.
    Child(const std::string& program, std::vector<std::string> arguments, const std::filesystem::path& out = "/dev/null");
    ~Child();
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    [[nodiscard]] pid_t id() const { return id_; }
    void send(int signal) const;
    /// Waits until `reached`; throws std::runtime_error if the program ends before, or after two minutes.
    void wait_until(const std::function<bool()>& reached);
    /// Waits for the end. The exit code; minus the signal if one ended it.
    int wait();

private:
    bool has_ended(int options);

    pid_t id_ = 0;
    bool ended_ = false;
    int status_ = 0;
};

/// 0 if the file is not there.
[[nodiscard]] std::size_t lines_in(const std::filesystem::path& path);

/// Arguments of abut: a small scene that would take hours.
[[nodiscard]] std::vector<std::string> long_run(const std::filesystem::path& out);

/// Whether a folder holds a file that is not finished, or a lock.
[[nodiscard]] bool any_partial(const std::filesystem::path& directory);

}  // namespace abut::test::programs
