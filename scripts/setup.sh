#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Installs what scripts/packages.txt lists and this machine lacks, by apt-get.
#
#   scripts/setup.sh [GROUP...]   the groups build and sim, and those named
#   scripts/setup.sh --doctor     report on every group, install nothing
#
# Exit codes: 0 all tools are present, 2 bad usage, 3 something is missing or too old.
set -eu
export LC_ALL=C
cd "$(dirname "$0")/.."

list=scripts/packages.txt
log=build/setup.log
needed_groups="build sim"
lock_seconds=${HALFWAY_LOCK_SECONDS:-300}
tab=$(printf '\t')

say() { printf 'set-up: %s\n' "$*" >&2; }

# The main version of the clang that is installed, or of the one that apt would install; empty if neither is known.
clang_version() {
  { dpkg-query -W -f '${Version}' clang || apt-cache show --no-all-versions clang; } 2>/dev/null |
    sed -n -e 's/^Version: //' -e 's/^\([0-9]*:\)\{0,1\}\([0-9][0-9]*\)\..*/\2/p'
}

# Every line of the list without comments, with tabs between its six columns.
rows() {
  awk -v OFS='\t' -v clang="$(clang_version)" '!/^ *(#|$)/ { if (clang == "") gsub(/-@/, ""); gsub(/@/, clang); u = $6; for (i = 7; i <= NF; i++) u = u " " $i
    print $1, $2, $3, $4, $5, u }' "$list"
}

find_header() {
  for folder in /usr/include /usr/include/*-linux-gnu* /usr/local/include; do
    for file in $folder/$1; do [ ! -f "$file" ] || return 0; done
  done
  old_ifs=$IFS
  IFS=:
  for folder in ${CPATH-}; do
    if [ -f "$folder/$1" ]; then
      IFS=$old_ifs
      return 0
    fi
  done
  IFS=$old_ifs
  return 1
}

# The version that the package manager knows, without epoch and Debian's revision; empty if it knows none.
package_version() {
  command -v dpkg-query >/dev/null || return 0
  dpkg-query -W -f '${db:Status-Status} ${Version}\n' "$1" 2>/dev/null |
    sed -n 's/^installed \([0-9]*:\)\{0,1\}\([0-9.]*\).*/\2/p' || true
}

# Sets `found` to a version, or "?" where none can be read, and `state` to ok, older, broken or missing.
examine() { # package provides minimum
  found=-
  state=missing
  case $2 in
    */* | *.*)
      find_header "$2" || return 0
      found=$(package_version "$1")
      ;;
    *)
      command -v "$2" >/dev/null || return 0
      # Some know no --version, and end with 1. A tool that does not start ends with 126 or more.
      status=0
      found=$("$2" --version 2>&1 </dev/null) || status=$?
      if [ "$status" -ge 126 ]; then
        state=broken found='?'
        return 0
      fi
      found=$(printf '%s\n' "$found" | grep -oE '[0-9]+(\.[0-9]+)+' | head -n 1) || true
      ;;
  esac
  state=ok
  if [ -z "$found" ]; then
    found='?'
  elif [ "$(printf '%s\n%s\n' "$3" "$found" | sort -V | head -n 1)" != "$3" ]; then
    state=older
  fi
}

# The names of the packages in the groups given that are missing or older, on one line.
lacking() {
  rows | while IFS=$tab read -r group package provides minimum tested use; do
    case " $* " in *" $group "*) ;; *) continue ;; esac
    examine "$package" "$provides" "$minimum"
    if [ "$state" != ok ]; then printf ' %s' "$package"; fi
  done
}

# Of the packages given, what apt does not know, a line each: what it has to provide, and the lowest version.
unknown() {
  known=$(apt-cache show --no-all-versions "$@" 2>/dev/null | sed -n 's/^Package: //p')
  for name in "$@"; do
    if printf '%s\n' "$known" | grep -qxF -e "$name"; then continue; fi
    rows | awk -F '\t' -v name="$name" '$2 == name { printf "  %s: provides %s, at least version %s: %s\n", name, $3, $4, $6 }'
  done
}

# What is found of the packages given, on one line.
state_of() {
  rows | while IFS=$tab read -r group package provides minimum tested use; do
    case " $* " in *" $package "*) ;; *) continue ;; esac
    examine "$package" "$provides" "$minimum"
    case $state in
      older | broken) printf ' %s is %s (version %s; at least %s);' "$provides" "$state" "$found" "$minimum" ;;
      missing) printf ' %s is missing;' "$package" ;;
    esac
  done
}

as_root() {
  if [ "$(id -u)" = 0 ]; then
    env DEBIAN_FRONTEND=noninteractive "$@"
  else
    sudo -n env DEBIAN_FRONTEND=noninteractive "$@"
  fi
}

can_be_root() { [ "$(id -u)" = 0 ] || { command -v sudo >/dev/null && sudo -n env true 2>/dev/null; }; }

# The one command that a reader can paste to install what is missing.
mending_command() {
  if ! command -v apt-get >/dev/null; then
    printf 'this machine has no apt-get: install what Debian calls%s' "$*"
    return
  fi
  command="apt-get update && apt-get install -y --no-install-recommends$*"
  if [ "$(id -u)" = 0 ]; then
    printf '%s' "$command"
  elif command -v sudo >/dev/null; then
    printf "sudo sh -c '%s'" "$command"
  else
    printf "su -c '%s'" "$command"
  fi
}

# Runs apt-get into the log, and waits while another process holds one of its locks; 2 if that takes too long.
apt() {
  waited=0
  while ! as_root apt-get -q -y "$@" >"$log.part" 2>&1 </dev/null; do
    cat "$log.part" >>"$log"
    grep -q 'Could not get lock\|Unable to lock\|Unable to acquire the dpkg' "$log.part" || return 1
    if [ "$waited" -ge "$lock_seconds" ]; then
      say "another process still holds apt's lock after $waited seconds: let it end, then run this again"
      return 2
    fi
    if [ "$waited" = 0 ]; then say "another process holds apt's lock: waiting up to $lock_seconds seconds"; fi
    sleep 2
    waited=$((waited + 2))
  done
  cat "$log.part" >>"$log"
}

install() {
  # shellcheck disable=SC2086 # the names are words on purpose
  set -- $1
  status=0
  apt install --no-install-recommends "$@" || status=$?
  if [ "$status" != 1 ]; then return "$status"; fi
  say "apt-get install failed: trying again with fresh package lists"
  apt update && apt install --no-install-recommends "$@"
}

fail() { # packages why
  say "$2:$(state_of "$1")"
  say "this command mends it: $(mending_command "$1")"
  exit 3
}

# The answer depends on the list, the packages installed, and where commands and headers are searched for.
machine_key() {
  printf '%s|%s|%s|%s' "$(cksum <"$list")" "$(stat -c %y /var/lib/dpkg/status 2>/dev/null || true)" "$PATH" "${CPATH-}"
}

set_up() {
  groups="$needed_groups $*"
  stamp=$(printf 'build/setup'; [ $# = 0 ] || printf -- '-%s' "$@"; printf '.stamp')
  for group in "$@"; do
    rows | cut -f 1 | grep -qxF -e "$group" || { say "no group $group in $list"; exit 2; }
  done

  # Nothing to do while the machine is as it was when all was found.
  key=$(machine_key)
  if [ -f "$stamp" ] && [ "$(cat "$stamp")" = "$key" ]; then return; fi

  # shellcheck disable=SC2086
  packages=$(lacking $groups)
  if [ -n "$packages" ]; then
    command -v apt-get >/dev/null || fail "$packages" "there is no apt-get here"
    can_be_root || fail "$packages" "installing needs root, or sudo without a password"
    mkdir -p build
    : >"$log"
    # shellcheck disable=SC2086
    strange=$(unknown $packages)
    if [ -n "$strange" ]; then
      # The package lists may be missing or old.
      apt update || fail "$packages" "apt-get update failed, see $log"
      # shellcheck disable=SC2086
      packages=$(lacking $groups)
      # shellcheck disable=SC2086
      strange=$(unknown $packages)
    fi
    if [ -n "$strange" ]; then
      say "$(. /etc/os-release 2>/dev/null && printf '%s' "${PRETTY_NAME-}"): these packages have no such name here, so nothing is installed:"
      printf '%s\n' "$strange" >&2
      say "install by hand what they provide"
      for name in $packages; do
        case "$strange" in *"  $name: "*) ;; *) known="${known-} $name" ;; esac
      done
      [ -z "${known-}" ] || say "and the others with: $(mending_command "$known")"
      exit 3
    fi
    say "installing$packages"
    say "(a few minutes on a bare machine; log: $log)"
    began=$(date +%s)
    if ! install "$packages"; then
      tail -n 12 "$log.part" >&2
      fail "$packages" "apt-get failed, see $log"
    fi
    rm -f "$log.part"
    # shellcheck disable=SC2086
    packages=$(lacking $groups)
    [ -z "$packages" ] || fail "$packages" "apt-get ended well, but its packages are too old or not whole"
    say "done in $(($(date +%s) - began)) s"
    key=$(machine_key)
  fi
  mkdir -p build
  printf '%s\n' "$key" >"$stamp"
}

doctor() {
  printf '%-8s %-20s %-10s %-10s %-10s %-9s %s\n' group package found minimum tested state use
  rows | while IFS=$tab read -r group package provides minimum tested use; do
    examine "$package" "$provides" "$minimum"
    printf '%-8s %-20s %-10s %-10s %-10s %-9s %s\n' \
      "$group" "$package" "$found" "$minimum" "$tested" "$state" "$use"
  done
  echo
  for group in $(rows | cut -f 1 | uniq); do
    case " $needed_groups " in *" $group "*) continue ;; esac
    packages=$(lacking "$group")
    [ -z "$packages" ] || printf 'optional group %s: %s\n' "$group" "$(mending_command "$packages")"
  done
  # shellcheck disable=SC2086
  packages=$(lacking $needed_groups)
  if [ -n "$packages" ]; then
    printf 'missing or too old:%s\nthis command mends it: %s\n' "$packages" "$(mending_command "$packages")"
    exit 3
  fi
  echo 'All that the project needs is here.'
}

case ${1-} in
  --doctor) doctor ;;
  -*)
    say "unknown option $1; usage: scripts/setup.sh [GROUP...] or scripts/setup.sh --doctor"
    exit 2
    ;;
  *) set_up "$@" ;;
esac
