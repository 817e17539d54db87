/// \file
/// run_measured PROGRAM ARGUMENTS...: runs a program, drops what it prints to standard output, and
/// prints its exit status and its largest resident set in bytes. A process counts as its own what
/// the one it was copied from had in memory; so the bench, which is large, starts this one, which
/// is small.

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>

int main(int argc, char** argv) {
    if (argc < 2) return 2;
    const pid_t child = ::fork();
    if (child < 0) return 1;
    if (child == 0) {
        const int nowhere = ::open("/dev/null", O_WRONLY);
        if (nowhere < 0 || ::dup2(nowhere, STDOUT_FILENO) < 0) ::_exit(127);
        ::execv(argv[1], argv + 1);
        ::_exit(127);
    }
    int status = 0;
    struct rusage usage {};
    if (::wait4(child, &status, 0, &usage) != child || !WIFEXITED(status)) return 1;
    std::printf("%d %lld\n", WEXITSTATUS(status), 1024LL * usage.ru_maxrss);
    return 0;
}
