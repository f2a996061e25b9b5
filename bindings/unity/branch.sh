#!/usr/bin/env bash
# Commits a folder that package.sh made as all of a branch, for git URLs (REPOSITORY#BRANCH): a package with its libraries
# at the root. Nothing is checked out; the branch is made where it is not there, and nothing where it holds that already.
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
rm "$index" # git wants none, or one of its own
export GIT_INDEX_FILE=$index
git --work-tree="$folder" add --force --all "$folder" # libraries are ignored elsewhere
tree=$(git write-tree)
parent=$(git rev-parse -q --verify "$ref" || true)
if [ -n "$parent" ] && [ "$(git rev-parse "$parent^{tree}")" = "$tree" ]; then
    echo "branch: $2 holds this package already"
    exit 0
fi
commit=$(git commit-tree "$tree" ${parent:+-p "$parent"} -m "com.knurl.haptics $version, with its libraries")
git update-ref "$ref" "$commit" "${parent:-}"
echo "branch: $2 is com.knurl.haptics $version; push it, and add REPOSITORY#$2 in the Package Manager"
