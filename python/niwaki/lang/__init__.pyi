from . import advice as advice
