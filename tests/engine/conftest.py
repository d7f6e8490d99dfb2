"""What is a law in a plane and in space is tried in both."""

import pytest


@pytest.fixture(params=[2, 3])
def dimensions(request):
    return request.param
