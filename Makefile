# `make run` and `make test` are all it takes; the rest is listed by `make help`.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
PORT ?= 8000
MAP ?= models/maps/helsinki.osm.pbf
INDEX ?= data/index
IMAGE ?= hereabouts
KILLS ?= 200
# Python compiles what it imports; pip would compile all of it, which takes as long as the rest.
PIP := $(BIN)/pip install --quiet --disable-pip-version-check --no-compile
# Each process takes 1 to 2 GB. Files are shared out in runs, so that a module's fixtures are made by one of them.
PYTEST := $(BIN)/python -m pytest --numprocesses logical --maxprocesses 4 --dist worksteal
# What pip is asked for first; set it to choose another build of torch, for example TORCH=./torch-2.13.0+cu130.whl.
TORCH ?= $(shell grep '^torch==' constraints.txt)
HELSINKI := --data models/maps/helsinki.osm.pbf
TRAINED_ON := --data data/towns-own-0 --data data/towns-own-1 $(HELSINKI)
FITTED_TO := --data data/towns-0 --data data/towns-own-1 $(HELSINKI)
# The shipped kernels of places are fitted to texts about midtown Manhattan too, whose map does not ship: give
# MIDTOWN=midtown.osm.pbf RVS=midtown_dev.jsonl.gz (docs/use.md says what they are); without, to the maps here alone.
PEOPLE := models/reports/people
comma := ,
TOLD_OF := $(if $(MIDTOWN),--data $(MIDTOWN) --texts $(PEOPLE)/manhattan_dev.jsonl$(if $(RVS),$(comma)$(RVS))) \
	$(HELSINKI) --texts $(PEOPLE)/helsinki_west.jsonl \
	--data models/maps/alexanderplatz.osm.pbf --texts $(PEOPLE)/alexanderplatz_dev.jsonl

# Set in some containers; every process would then compile torch's sources anew, four seconds each.
unexport PYTHONDONTWRITEBYTECODE

.PHONY: help install run test test-fast fuzz load soak chaos check check-page format sbom audit towns train refit index serve evaluate benchmark web page wheels image clean

help:  ## what can be made
	@sed -n 's/^\([a-z-]*\):.*##/\1\t/p' $(MAKEFILE_LIST)

$(BIN)/.installed: pyproject.toml constraints.txt
	$(PYTHON) -m venv $(VENV)
	$(PIP) $(TORCH)
	$(PIP) --constraint constraints.txt --editable '.[dev]'
	touch $@

install: $(BIN)/.installed  ## virtual environment with everything in it

index: install  ## index MAP into INDEX, if it is not there
	$(BIN)/hereabouts index --map $(MAP) --out $(INDEX) --keep-current

run: index  ## install, index the shipped city if it is not, serve on PORT
	$(BIN)/hereabouts serve --index $(INDEX) --port $(PORT)

serve: install  ## serve INDEX on PORT
	$(BIN)/hereabouts serve --index $(INDEX) --port $(PORT)

test: install  ## the whole test suite
	$(PYTEST)

test-fast: install  ## what is quick of it, of every package
	$(PYTEST) -m 'not slow'

fuzz: install  ## the contract and raw mutations, for much longer than the suite has time
	FUZZ_EXAMPLES=2000 FUZZ_MUTATIONS=10000 $(PYTEST) tests/app/http/test_contract.py tests/app/http/test_mutations.py

load: install  ## what the service bears on this machine, which has to be idle: clients, arrivals, three times too much
	$(BIN)/python -m tests.load.load --index $(INDEX)

soak: install  ## whether memory grows in 100,000 requests
	$(BIN)/python -m tests.load.soak --index $(INDEX)

chaos: install  ## KILLS kills of builds and of the service at random moments, and 200 switches: nothing acknowledged may be lost
	$(BIN)/python -m tests.load.chaos --kills $(KILLS)
	SWITCHES=200 $(BIN)/python -m pytest tests/app/http/test_switching.py

check: install  ## ruff and mypy
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy

format: install  ## let ruff format and fix
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .

sbom: install  ## what is installed, as a CycloneDX bill of materials: reports/sbom.json
	mkdir -p reports
	$(BIN)/cyclonedx-py environment --pyproject pyproject.toml --output-reproducible --output-file reports/sbom.json $(BIN)/python

# Strict, or what the registry does not answer for passes as sound.
audit: install  ## known vulnerabilities of what constraints.txt pins, as PyPI tells them
	$(BIN)/pip-audit --requirement constraints.txt --no-deps --disable-pip --strict --progress-spinner off

towns: install  ## the made-up towns that weights are trained on, with KITTI-360's numbers and with their own
	for towns in 0 own-0 own-1; do \
		test -d data/raw-$$towns || $(BIN)/hereabouts synth --seed $${towns#own-} --out data/raw-$$towns \
			--pieces $$(case $$towns in own-*) echo own;; *) echo official;; esac) && \
		$(BIN)/hereabouts prepare --raw data/raw-$$towns --out data/towns-$$towns || exit 1; \
	done

train: towns  ## make the shipped weights again (west of Helsinki, made-up towns, texts about real places)
	$(BIN)/hereabouts train --method mncl $(TRAINED_ON) --out models/weights/retriever \
		--set model.width=128 --set training.batch_size=64 --set training.steps=2200
	$(BIN)/hereabouts train --method regressor $(TRAINED_ON) --out models/weights/regressor
	$(BIN)/hereabouts train --method matching $(TRAINED_ON) --out models/weights/matching
	$(BIN)/hereabouts train --method posterior $(FITTED_TO) --out models/weights/posterior
	$(BIN)/hereabouts train --method places --reader models/weights/posterior $(TOLD_OF) --out models/weights/posterior

refit: towns  ## fit the shipped posterior's likelihood again, with the reader that it has
	$(BIN)/hereabouts train --method posterior $(FITTED_TO) --reader models/weights/posterior --out models/weights/posterior

evaluate: install  ## recall on the held-out east of Helsinki and on Alexanderplatz
	for how in posterior regressor matching none; do \
		$(BIN)/hereabouts evaluate --data models/maps/helsinki.osm.pbf --split test --refine $$how --report reports/helsinki-$$how && \
		$(BIN)/hereabouts evaluate --data models/maps/alexanderplatz.osm.pbf --refine $$how --report reports/alexanderplatz-$$how \
		|| exit 1; \
	done

benchmark: index  ## seconds, memory and latency on this machine
	$(BIN)/hereabouts benchmark --map $(MAP) --index $(INDEX)

web:  ## open the page of the running service
	$(PYTHON) -m webbrowser http://127.0.0.1:$(PORT)/

page: install  ## build the page (app/web/page) from its sources, which takes Node.js
	$(BIN)/python -c "import json; from app.main import create_app; from app.settings import Settings; \
		print(json.dumps(create_app(Settings()).openapi()))" > app/web/source/schema.json
	cd app/web/source && npm ci --silent --no-audit --no-fund && npm run --silent types && npm run --silent check \
		&& npm run --silent build

check-page: install  ## whether the page that is committed is what its sources make
	committed=$$(mktemp -d) && cp -r app/web/page app/web/source/src $$committed && $(MAKE) page \
		&& diff -r $$committed/page app/web/page && diff -r $$committed/src app/web/source/src \
		|| { echo "the page is not what its sources make: run make page and commit it"; exit 1; }

wheels: install  ## put this machine's build of torch where the image build finds it
	$(BIN)/pip download --quiet --no-deps --dest docker/wheels $(TORCH)

image:  ## the container image
	docker build --file docker/Dockerfile --tag $(IMAGE) .

clean:  ## remove what was made
	rm -rf $(VENV) data reports runs
