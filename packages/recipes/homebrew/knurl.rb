# Knurl's tool, libraries and headers for Homebrew, from a release's source archive that ./run release has made in this
# checkout: `brew install --formula ./packages/recipes/homebrew/knurl.rb`. Whoever publishes it puts the archive's address
# here, and its line of SHA256SUMS as sha256. SPDX-License-Identifier: MIT
class Knurl < Formula
  desc "Haptic gratings on force-feedback devices"
  homepage "https://doi.org/10.1109/TOH.2021.3072588"
  version "0.3.0"
  url "file://#{File.expand_path("../../../build/release-0.3.0/knurl-0.3.0-source.tar.gz", __dir__)}"
  license "MIT"

  depends_on "cmake" => :build
  depends_on "glm" => :build
  depends_on "nlohmann-json" => :build
  depends_on "pkgconf" => :build
  depends_on "hidapi" # loaded at run time, as libusb is
  depends_on "libusb"

  resource "tinygltf" do # a header, compiled in
    url "https://github.com/syoyo/tinygltf/archive/v2.9.7.tar.gz"
    sha256 "bf92fe53b86302f9415e77504ecd81a58659292ed04dffec873f5c71665046a0"
  end

  def install
    resource("tinygltf").stage(buildpath/"tinygltf")
    system "cmake", "-S", ".", "-B", "build", *std_cmake_args, "-DBUILD_SHARED_LIBS=ON", "-DBUILD_TESTING=OFF", "-DKNURL_VIEW=OFF",
           "-DKNURL_PICTURES=OFF", "-DKNURL_INVERSE3=OFF", "-DTINYGLTF_INCLUDE_DIR=#{buildpath}/tinygltf"
    system "cmake", "--build", "build"
    system "cmake", "--install", "build"
    pkgshare.install Dir["assets/*.glb"]
  end

  test do
    system bin/"knurl", "run", pkgshare/"plate_1d.glb", "--fast", "--seconds", "1", "--out", testpath/"felt.csv"
    assert_equal 1001, (testpath/"felt.csv").each_line.count
  end
end
