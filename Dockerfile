# seifbed on Debian 12. It builds the Debian package, and installs it:
#   docker build -t seifbed . && docker run --rm -v "$PWD/runs:/runs" seifbed run courtyard --out /runs/courtyard
FROM debian:12 AS build
COPY . /source
WORKDIR /source
SHELL ["/bin/bash", "-c"]
RUN root=/source && source harness/setup.sh && install_packages && \
    apt-get install --yes --no-install-recommends dpkg-dev file
RUN cmake --preset package && cmake --build --preset package && cpack --config build/package/CPackConfig.cmake -B /package

FROM debian:12
COPY --from=build /package/*.deb /tmp/
RUN apt-get update && apt-get install --yes --no-install-recommends /tmp/*.deb libosmesa6 ffmpeg gnuplot-nox && \
    rm -rf /tmp/*.deb /var/lib/apt/lists/*
ENTRYPOINT ["seifbed"]
