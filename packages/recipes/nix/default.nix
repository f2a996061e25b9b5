# Knurl's tool, libraries and headers: `nix-build packages/recipes/nix`, in a checkout or an unpacked source archive.
# SPDX-License-Identifier: MIT
{ pkgs ? import <nixpkgs> { } }:
let
  header = builtins.readFile ../../../sdk/include/knurl/base.h;
  number = part: builtins.head (builtins.match ".*define KNURL_VERSION_${part} ([0-9]+).*" header);
in
pkgs.stdenv.mkDerivation {
  pname = "knurl";
  version = "${number "MAJOR"}.${number "MINOR"}.${number "PATCH"}";
  src = pkgs.lib.cleanSourceWith {
    src = ../../..;
    filter = path: type: !(type == "directory" && baseNameOf path == "build");
  };
  nativeBuildInputs = with pkgs; [ cmake ninja pkg-config ];
  buildInputs = with pkgs; [ tinygltf nlohmann_json glm libusb1 hidapi libwebsockets kissfft libpng libjpeg ];
  cmakeFlags = [ "-DBUILD_SHARED_LIBS=ON" "-DBUILD_TESTING=OFF" ];
  meta = {
    description = "Haptic gratings on force-feedback devices";
    homepage = "https://doi.org/10.1109/TOH.2021.3072588";
    license = pkgs.lib.licenses.mit;
    platforms = pkgs.lib.platforms.linux ++ pkgs.lib.platforms.darwin;
    mainProgram = "knurl";
  };
}
