/*
 * What unpacker.wasm offers: libarchive's readers of RAR, 7-Zip and XZ over a file that the page
 * reads for it. One archive an instance. It has no other way out: the functions of WASI that
 * the C library imports are refused by unpacker.ts. scripts/build_unpacker.mjs builds it.
 */
#include <errno.h>
#include <locale.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "archive.h"
#include "archive_entry.h"

#define EXPORT(name) __attribute__((export_name(#name)))

/* Copies bytes of the archive to `to`; returns how many, or -1 if it cannot be read. */
__attribute__((import_module("page"), import_name("read"))) extern int page_read(
    void *to, int offset, int length);

static struct archive *archive;
static struct archive_entry *entry;
static int64_t position, size;
static char input[1 << 16];
static char output[1 << 18];

static la_ssize_t read_input(struct archive *a, void *data, const void **buffer) {
  (void)data;
  int64_t rest = size - position;
  if (rest <= 0) return 0;
  int length = rest < (int64_t)sizeof input ? (int)rest : (int)sizeof input;
  int count = page_read(input, (int)position, length);
  if (count <= 0 || count > length) {
    archive_set_error(a, EIO, "it cannot be read");
    return ARCHIVE_FATAL;
  }
  position += count;
  *buffer = input;
  return count;
}

static int64_t move_to(int64_t place) {
  position = place < 0 ? 0 : place > size ? size : place;
  return position;
}

static la_int64_t skip_input(struct archive *a, void *data, la_int64_t length) {
  (void)a, (void)data;
  int64_t before = position;
  return length <= 0 ? 0 : move_to(length > size - before ? size : before + length) - before;
}

static la_int64_t seek_input(struct archive *a, void *data, la_int64_t offset, int whence) {
  (void)a, (void)data;
  int64_t from = whence == SEEK_SET ? 0 : whence == SEEK_CUR ? position : size;
  if (offset > size || offset < -size) offset = offset < 0 ? -size : size;
  return move_to(from + offset);
}

/*
 * Opens an archive of `length` bytes from its start, in place of one that is open; if `is_xz`, a file
 * packed by XZ, which is its one entry. Returns libarchive's status.
 */
EXPORT(open) int open_archive(int length, int is_xz) {
  if (archive) archive_read_free(archive);
  /* Names are UTF-8. */
  setlocale(LC_CTYPE, "C.UTF-8");
  entry = NULL;
  position = 0;
  size = length;
  archive = archive_read_new();
  if (!archive) return ARCHIVE_FATAL;
  if (is_xz) {
    archive_read_support_filter_xz(archive);
    archive_read_support_format_raw(archive);
    archive_read_support_format_empty(archive);
  } else {
    archive_read_support_format_rar(archive);
    archive_read_support_format_rar5(archive);
    archive_read_support_format_7zip(archive);
  }
  archive_read_set_callback_data(archive, NULL);
  archive_read_set_read_callback(archive, read_input);
  archive_read_set_skip_callback(archive, skip_input);
  archive_read_set_seek_callback(archive, seek_input);
  return archive_read_open1(archive);
}

/* Goes on to the next entry. Returns libarchive's status. */
EXPORT(next) int next_entry(void) {
  return archive_read_next_header(archive, &entry);
}

/* Returns whether the entry is a file of its own: no folder, no link. */
EXPORT(isFile) int is_file(void) {
  return archive_entry_filetype(entry) == AE_IFREG && !archive_entry_hardlink(entry);
}

/* Returns the entry's path: UTF-8, or bytes of an unknown encoding. */
EXPORT(path) const char *path(void) {
  const char *name = archive_entry_pathname_utf8(entry);
  if (!name) name = archive_entry_pathname(entry);
  return name ? name : "";
}

/* Returns whether an encrypted entry was seen, or the list of entries is encrypted. */
EXPORT(isEncrypted) int is_encrypted(void) {
  return archive_read_has_encrypted_entries(archive) > 0 ||
         (entry && archive_entry_is_encrypted(entry));
}

/* Unpacks the next bytes of the entry into `output`. Returns how many, or libarchive's status. */
EXPORT(unpack) int unpack_bytes(void) {
  return (int)archive_read_data(archive, output, sizeof output);
}

EXPORT(output) char *output_buffer(void) {
  return output;
}

/* Returns what libarchive says of its last failure. */
EXPORT(reason) const char *reason(void) {
  const char *text = archive ? archive_error_string(archive) : NULL;
  return text ? text : "";
}
