// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/simulation/sim_disk.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <cstring>
#include <new>

namespace seaway::testing {
namespace {

struct Handle {
  sqlite3_file base;
  SimDisk* disk;
  std::shared_ptr<SimDisk::File>* file;
  std::string* path;
  int lock;
};

Handle* of(sqlite3_file* f) { return reinterpret_cast<Handle*>(f); }
SimDisk::File& content(sqlite3_file* f) { return **of(f)->file; }

void put(std::string& bytes, std::int64_t at, std::string_view data) {
  if (bytes.size() < static_cast<std::size_t>(at) + data.size()) bytes.resize(static_cast<std::size_t>(at) + data.size(), '\0');
  std::memcpy(bytes.data() + at, data.data(), data.size());
}

int unlock(sqlite3_file* f, int level) {
  if (of(f)->lock > SQLITE_LOCK_NONE && level == SQLITE_LOCK_NONE) --content(f).holders;
  of(f)->lock = level;
  return SQLITE_OK;
}
/// One thread: what matters is that the last connection knows that it is the last.
int lock(sqlite3_file* f, int level) {
  if (level == SQLITE_LOCK_EXCLUSIVE && content(f).holders > (of(f)->lock > SQLITE_LOCK_NONE ? 1 : 0)) return SQLITE_BUSY;
  if (of(f)->lock == SQLITE_LOCK_NONE && level > SQLITE_LOCK_NONE) ++content(f).holders;
  of(f)->lock = level;
  return SQLITE_OK;
}

int close_file(sqlite3_file* f) {
  unlock(f, SQLITE_LOCK_NONE);
  delete of(f)->file;
  delete of(f)->path;
  return SQLITE_OK;
}
int read_file(sqlite3_file* f, void* out, int n, sqlite3_int64 at) {
  const std::string& bytes = content(f).now;
  const auto have = std::clamp<std::int64_t>(static_cast<std::int64_t>(bytes.size()) - at, 0, n);
  if (have > 0) std::memcpy(out, bytes.data() + at, static_cast<std::size_t>(have));
  if (have == n) return SQLITE_OK;
  std::memset(static_cast<char*>(out) + have, 0, static_cast<std::size_t>(n - have));
  return SQLITE_IOERR_SHORT_READ;
}
int write_file(sqlite3_file* f, const void* data, int n, sqlite3_int64 at) {
  SimDisk& disk = *of(f)->disk;
  if (!disk.may_change()) return SQLITE_IOERR_WRITE;
  if (disk.full()) return SQLITE_FULL;
  const std::string_view bytes(static_cast<const char*>(data), static_cast<std::size_t>(n));
  put(content(f).now, at, bytes);
  content(f).unsynced.push_back({at, std::string(bytes)});
  return SQLITE_OK;
}
int truncate_file(sqlite3_file* f, sqlite3_int64 size) {
  if (!of(f)->disk->may_change()) return SQLITE_IOERR_TRUNCATE;
  content(f).now.resize(static_cast<std::size_t>(size));
  content(f).unsynced.push_back({size, "", true});
  return SQLITE_OK;
}
int sync_file(sqlite3_file* f, int) {
  if (!of(f)->disk->may_change()) return SQLITE_IOERR_FSYNC;
  content(f).synced = content(f).now;
  content(f).unsynced.clear();
  return SQLITE_OK;
}
int file_size(sqlite3_file* f, sqlite3_int64* out) {
  *out = static_cast<sqlite3_int64>(content(f).now.size());
  return SQLITE_OK;
}
int check_lock(sqlite3_file*, int* out) {
  *out = 0;
  return SQLITE_OK;
}
int control(sqlite3_file*, int, void*) { return SQLITE_NOTFOUND; }
int sector(sqlite3_file*) { return 512; }
int characteristics(sqlite3_file*) { return SQLITE_IOCAP_POWERSAFE_OVERWRITE; }

int map_shared(sqlite3_file* f, int page, int size, int extend, void volatile** out) {
  auto& shared = of(f)->disk->shared[*of(f)->path];
  if (shared == nullptr) shared = std::make_shared<SimDisk::Shared>();
  *out = nullptr;
  if (static_cast<std::size_t>(page) >= shared->regions.size() && !extend) return SQLITE_OK;
  while (shared->regions.size() <= static_cast<std::size_t>(page))
    shared->regions.push_back(std::make_unique<char[]>(static_cast<std::size_t>(size)));
  *out = shared->regions[static_cast<std::size_t>(page)].get();
  return SQLITE_OK;
}
// One thread, and no statement is open between two calls: nobody ever waits for a lock.
int lock_shared(sqlite3_file*, int, int, int) { return SQLITE_OK; }
void barrier(sqlite3_file*) {}
int unmap_shared(sqlite3_file* f, int remove) {
  if (remove != 0) of(f)->disk->shared.erase(*of(f)->path);
  return SQLITE_OK;
}

const sqlite3_io_methods methods{2,         close_file, read_file, write_file, truncate_file, sync_file,   file_size,
                                 lock,      unlock,     check_lock, control,   sector,        characteristics,
                                 map_shared, lock_shared, barrier,  unmap_shared, nullptr,    nullptr};

SimDisk& disk_of(sqlite3_vfs* vfs) { return *static_cast<SimDisk*>(vfs->pAppData); }

int open_file(sqlite3_vfs* vfs, const char* name, sqlite3_file* f, int flags, int* out_flags) {
  SimDisk& disk = disk_of(vfs);
  f->pMethods = nullptr;
  const std::string path = name != nullptr ? name : "temporary" + std::to_string(disk.random());
  auto& file = disk.files[path];
  if (file == nullptr) {
    if ((flags & SQLITE_OPEN_CREATE) == 0 || !disk.may_change()) {
      disk.files.erase(path);
      return SQLITE_CANTOPEN;
    }
    file = std::make_shared<SimDisk::File>();
  }
  of(f)->disk = &disk;
  of(f)->lock = SQLITE_LOCK_NONE;
  of(f)->file = new std::shared_ptr<SimDisk::File>(file);
  of(f)->path = new std::string(path);
  of(f)->base.pMethods = &methods;
  if (out_flags != nullptr) *out_flags = flags;
  return SQLITE_OK;
}
int delete_file(sqlite3_vfs* vfs, const char* name, int) {
  SimDisk& disk = disk_of(vfs);
  if (!disk.may_change()) return SQLITE_IOERR_DELETE;
  return disk.files.erase(name) > 0 ? SQLITE_OK : SQLITE_IOERR_DELETE_NOENT;
}
int access_file(sqlite3_vfs* vfs, const char* name, int, int* out) {
  *out = disk_of(vfs).files.count(name) > 0 ? 1 : 0;
  return SQLITE_OK;
}
int full_path(sqlite3_vfs*, const char* name, int n, char* out) {
  sqlite3_snprintf(n, out, "%s", name);
  return SQLITE_OK;
}
int random_bytes(sqlite3_vfs* vfs, int n, char* out) {
  for (int i = 0; i < n; ++i) out[i] = static_cast<char>(disk_of(vfs).random());
  return n;
}
int sleep(sqlite3_vfs*, int us) { return us; }
int current_time(sqlite3_vfs*, double* out) {
  *out = 2460000.5;
  return SQLITE_OK;
}
int last_error(sqlite3_vfs*, int, char*) { return 0; }

}  // namespace

SimDisk::SimDisk(std::string name, std::uint64_t seed) : random(seed), name_(std::move(name)) {
  auto* vfs = new sqlite3_vfs{};
  vfs->iVersion = 1;
  vfs->szOsFile = sizeof(Handle);
  vfs->mxPathname = 256;
  vfs->zName = name_.c_str();
  vfs->pAppData = this;
  vfs->xOpen = open_file;
  vfs->xDelete = delete_file;
  vfs->xAccess = access_file;
  vfs->xFullPathname = full_path;
  vfs->xRandomness = random_bytes;
  vfs->xSleep = sleep;
  vfs->xCurrentTime = current_time;
  vfs->xGetLastError = last_error;
  sqlite3_vfs_register(vfs, 0);
  vfs_ = vfs;
}

SimDisk::~SimDisk() {
  auto* vfs = static_cast<sqlite3_vfs*>(vfs_);
  sqlite3_vfs_unregister(vfs);
  delete vfs;
}

bool SimDisk::may_change() {
  if (left_ > 0) --left_;
  return left_ != 0;
}

void SimDisk::crash(bool power) {
  left_ = -1;
  full_ = false;
  shared.clear();
  for (auto& [path, file] : files) {
    if (power) {
      // Each write that was not synced has reached the disk, or in part, or not at all.
      file->now = file->synced;
      for (Write& w : file->unsynced) {
        const auto chance = random() % 4;
        if (w.truncate) {
          if (chance > 0) file->now.resize(static_cast<std::size_t>(w.at));
        } else if (chance > 1) {
          put(file->now, w.at, w.bytes);
        } else if (chance == 1) {
          put(file->now, w.at, std::string_view(w.bytes).substr(0, random() % w.bytes.size() / 512 * 512));
        }
      }
    }
    file->synced = file->now;
    file->unsynced.clear();
    file->holders = 0;
  }
}

}  // namespace seaway::testing
