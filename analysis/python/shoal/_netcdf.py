"""Files of netCDF."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from . import _shoal

if TYPE_CHECKING:
    import xarray


def load(file: str | os.PathLike[str], group: str | None = None) -> xarray.Dataset:
    """All of a file or of one of its groups, with times as numbers.

    The library would change a name with blanks or backslashes; in memory it needs none."""
    import netCDF4
    import xarray
    from xarray.backends import NetCDF4DataStore

    with open(file, "rb") as opened:
        content = opened.read()
    with _shoal.NetcdfLock(), netCDF4.Dataset("shoal", memory=content) as dataset:
        if group is not None and group not in dataset.groups:
            raise _shoal.InputError(f"there is no group {group!r}; known are {', '.join(dataset.groups) or 'none'}")
        return xarray.open_dataset(NetCDF4DataStore(dataset, group=group), decode_times=False).load()
