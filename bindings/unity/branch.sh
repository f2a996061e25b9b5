#!/usr/bin/env bash
# Commits a folder made by package.sh as the whole content of a branch, for git URLs (REPOSITORY#BRANCH): the package,
# with its libraries, at the root. Checks out nothing; creates the branch if needed; does nothing if the branch already
# has this content.
# usage: branch.sh FOLDER BRANCH     (in the repository)
set -euo pipefail
[ $# -eq 2 ] || { echo "usage: branch.sh FOLDER BRANCH" >&2; exit 2; }
folder=$(cd "$1" && pwd)
ref=refs/heads/$2
version=$(sed -n 's/^  "version": "\(.*\)",$/\1/p' "$folder/package.json")
git check-ref-format "$ref" || { echo "branch: expected a branch's name, found '$2'" >&2; exit 1; }
if [ "$(git symbolic-ref -q HEAD || true)" = "$ref" ]; then
    echo "branch: $2 is checked out: its files would not be what it holds" >&2
    exit 1
fi
index=$(mktemp)
trap 'rm -f "$index"' EXIT
rm "$index" # git accepts a missing index, but not an empty file
export GIT_INDEX_FILE=$index
git --work-tree="$folder" add --force --all "$folder" # --force: .gitignore lists libraries
tree=$(git write-tree)
parent=$(git rev-parse -q --verify "$ref" || true)
if [ -n "$parent" ] && [ "$(git rev-parse "$parent^{tree}")" = "$tree" ]; then
    echo "branch: $2 holds this package already"
    exit 0
fi
commit=$(git commit-tree "$tree" ${parent:+-p "$parent"} -m "com.knurl.haptics $version, with its libraries")
git update-ref "$ref" "$commit" "${parent:-}"
echo "branch: $2 is com.knurl.haptics $version; push it, and add REPOSITORY#$2 in the Package Manager"
