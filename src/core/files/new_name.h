#pragma once

namespace sward {

/// The system calls by which a file gets a name that must be new. Each takes UTF-8, and
/// returns 0, or -1 and sets errno. A test lets some of them fail, as file systems do that lack
/// them.
struct NamingCalls {
    int (*link)(const char* from,
                const char* to); ///< a second name; exFAT and the calls of Windows have none
    int (*moveToNew)(const char* from, const char* to); ///< renameat2 with RENAME_NOREPLACE
    int (*create)(const char* path);                    ///< an empty file; fails if it exists
    int (*moveOver)(const char* from, const char* to);  ///< rename
};

/// Those of the system.
extern const NamingCalls systemCalls;

/// Renames `temporary` to `path` in the same folder, unless that exists. Tries a link, then a
/// rename that replaces nothing, then a rename over an empty file that it has made itself. Returns
/// 0 or an errno; EEXIST if `path` exists.
int moveToNewName(const char* temporary, const char* path, const NamingCalls& calls = systemCalls);

} // namespace sward
