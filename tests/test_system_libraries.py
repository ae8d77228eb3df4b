from morphoskel import system_libraries
from morphoskel.system_libraries import ensure_libraries, install_command, missing_libraries


def test_nothing_is_missing_where_open3d_works():
    import open3d

    assert open3d.__version__
    assert missing_libraries() == []
    assert ensure_libraries() == ""


def test_a_missing_library_is_named_with_the_command_that_installs_it(monkeypatch):
    monkeypatch.setitem(system_libraries.PACKAGES, "libabsent.so.7", "libabsent7")
    monkeypatch.setattr(system_libraries.os, "geteuid", lambda: 1000)
    assert missing_libraries() == ["libabsent.so.7"]
    message = ensure_libraries()
    assert "libabsent.so.7" in message
    assert "sudo apt-get install --yes --no-install-recommends libabsent7" in message


def test_root_installs_what_is_missing(monkeypatch):
    commands = []
    monkeypatch.setitem(system_libraries.PACKAGES, "libabsent.so.7", "libabsent7")
    monkeypatch.setattr(system_libraries.os, "geteuid", lambda: 0)
    monkeypatch.setattr(system_libraries.shutil, "which", lambda name: f"/usr/bin/{name}")
    monkeypatch.setattr(system_libraries.subprocess, "run", lambda command, **_: commands.append(command))
    assert "libabsent7" in ensure_libraries()  # the pretended installation changed nothing
    assert commands == [["apt-get", "update", "--quiet", "--quiet"], install_command(["libabsent.so.7"])]
